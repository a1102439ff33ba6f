/* Zones of one time as one mesh in a plane, as the UGRID conventions have it, or as
 * points; zones of several times as the same at each. */
#include "decode/table/tecplot.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "terms/coordinates.h"

/* Arrays as the dataset has them: a variable's `id` is the number of its own. */
typedef struct mesh_state {
  size_t arrays;
  double *array[FG__TECPLOT_VARIABLES + 3];
} mesh_state;

static fg_status fetch(const fg__variable *v, const size_t *start, const size_t *count,
                       double *out)
{
  const mesh_state *s = v->owner->file[v->file].state;
  const double *from = s->array[v->id];
  const size_t inner = v->rank < 2 ? 1 : count[1];
  const size_t row = v->rank < 2 ? 1 : v->owner->dimensions[v->dimension[1]].length;
  for (size_t n = 0; n < count[0]; ++n)
    for (size_t i = 0; i < inner; ++i)
      *out++ = from[(start[0] + n) * row + (v->rank < 2 ? 0 : start[1] + i)];
  return FG_STATUS_OK;
}

static void close_state(void *state)
{
  mesh_state *s = state;
  for (size_t i = 0; i < s->arrays; ++i)
    free(s->array[i]);
}

static const fg__decoder DECODER = {.fetch = fetch,
                                    .state_bytes = sizeof(mesh_state),
                                    .close = close_state,
                                    .has_no_titles = true};

/* Adds a variable along one dimension, or two; NULL: no memory. Its array is taken over.
 */
static fg__variable *add(fg__dataset *dataset, mesh_state *s, const char *name,
                         double *array, int first, int second)
{
  fg__variable *v = array ? fg__dataset_add_variable(dataset, "", name) : NULL;
  if (!v) {
    free(array);
    return NULL;
  }
  v->plain_name = v->name;
  v->type = FG__TYPE_FLOAT64;
  v->rank = second < 0 ? 1 : 2;
  v->dimension[0] = first;
  v->dimension[1] = second;
  v->in_one_run = true;
  v->id = (int)s->arrays;
  s->array[s->arrays++] = array;
  return v;
}

/* What all zones of one time have together. */
typedef struct total {
  size_t zones, points, cells; /* of each time */
  size_t times;
  bool flat; /* cells are of a plane */
  int place[3];
} total;

static int find_place(const fg__tecplot *r, int k)
{
  for (int use = k < 2 ? FG__COLUMN_LONGITUDE + k : FG__COLUMN_Z; use >= 0;
       use = use > FG__COLUMN_Z ? k : -1)
    for (int v = 0; v < r->variables; ++v)
      if (fg__column_fits(r->column[v].name, (fg__column_use)use) == 2)
        return v;
  return -1;
}

static bool is_constant(const fg__tecplot *r, int variable)
{
  for (size_t i = 0; i < r->zones && variable >= 0; ++i)
    for (size_t n = 0; n < r->zone[i].points; ++n)
      if (r->zone[i].value[variable][n] != r->zone[0].value[variable][0])
        return false;
  return true;
}

/* Zones of one time follow each other, and are alike at all times. */
static fg_status find_total(total *out, const fg__tecplot *r)
{
  *out = (total){.times = 1, .flat = true};
  for (int k = 0; k < 3; ++k)
    out->place[k] = find_place(r, k);
  if (r->zones == 0)
    return FG_STATUS_OK;
  do {
    const fg__zone *z = &r->zone[out->zones++];
    out->points += z->points;
    out->cells += z->cells;
    out->flat = out->flat && z->cells > 0 && (z->corners < 4 || z->corners == 4) &&
                z->size[2] == 1;
  } while (out->zones < r->zones && !(r->zone[out->zones].time > r->zone[0].time ||
                                      r->zone[out->zones].time < r->zone[0].time));
  out->times = r->zones / out->zones;
  for (size_t i = out->zones; i < r->zones; ++i) {
    const fg__zone *a = &r->zone[i % out->zones], *b = &r->zone[i];
    bool alike = a->points == b->points && a->cells == b->cells &&
                 a->corners == b->corners && strcmp(a->centred, b->centred) == 0;
    for (int k = 0; k < 3 && alike && out->place[k] >= 0; ++k)
      alike = memcmp(a->value[out->place[k]], b->value[out->place[k]],
                     a->points * sizeof(double)) == 0;
    if (!alike || r->zones % out->zones != 0)
      return fg__fail(r->context, FG_STATUS_UNSUPPORTED,
                      "%s: line %d: the zone is of another time and other points than "
                      "the one of line %d",
                      r->path, b->line, a->line);
  }
  out->flat = out->flat && out->place[0] >= 0 && out->place[1] >= 0 &&
              is_constant(r, out->place[2]);
  return FG_STATUS_OK;
}

static double *gather(const fg__tecplot *r, const total *t, int variable, size_t times)
{
  const bool centred = fg__zone_is_centred(&r->zone[0], variable);
  const size_t each = centred ? t->cells : t->points;
  double *out = fg__allocate(each * times, sizeof *out);
  size_t used = 0;
  for (size_t i = 0; i < t->zones * times && out; ++i) {
    const fg__zone *z = &r->zone[i];
    const size_t count = centred ? z->cells : z->points;
    memcpy(out + used, z->value[variable], count * sizeof *out);
    used += count;
  }
  return out;
}

/* Corners of all cells, from 0; -1 where a triangle has none. */
static double *gather_cells(const fg__tecplot *r, const total *t)
{
  double *out = fg__allocate(t->cells * FG__TECPLOT_CORNERS, sizeof *out), *to = out;
  double before = 0.0;
  for (size_t i = 0; i < t->zones && out; ++i) {
    const fg__zone *z = &r->zone[i];
    const int corners = z->corners > 0 ? z->corners : FG__TECPLOT_CORNERS;
    for (size_t n = 0; n < z->cells; ++n)
      for (int c = 0; c < FG__TECPLOT_CORNERS; ++c)
        *to++ =
            c < corners ? before + z->node[n * (size_t)corners + (size_t)c] - 1 : -1.0;
    before += (double)z->points;
  }
  return out;
}

/* The mesh of a plane as the UGRID conventions describe it. */
static bool add_mesh(fg__dataset *dataset, mesh_state *s, const fg__tecplot *r,
                     const total *t, int faces)
{
  static const double fill = -1.0, start = 0.0;
  char places[2 * FG__TECPLOT_WORD];
  const fg__dimension *corners =
      fg__dataset_add_dimension(dataset, "corner", FG__TECPLOT_CORNERS);
  fg__variable *v = corners ? add(dataset, s, "cells", gather_cells(r, t), faces,
                                  (int)dataset->dimension_count - 1)
                            : NULL;
  if (!v || fg__variable_add_numbers(v, "_FillValue", &fill, 1, false) ||
      fg__variable_add_numbers(v, "start_index", &start, 1, false))
    return false;
  v = fg__dataset_add_variable(dataset, "", "zones");
  snprintf(places, sizeof places, "%s %s", r->column[t->place[0]].name,
           r->column[t->place[1]].name);
  return v && !fg__variable_add_text(v, "cf_role", "mesh_topology", 13) &&
         !fg__variable_add_text(v, "node_coordinates", places, strlen(places)) &&
         !fg__variable_add_text(v, "face_node_connectivity", "cells", 5);
}

static bool add_variables(fg__dataset *dataset, mesh_state *s, const fg__tecplot *r,
                          const total *t)
{
  fg__dimension *d = fg__dataset_add_dimension(dataset, "point", t->points);
  if (!d || !fg__dataset_add_group(dataset))
    return false;
  d->is_nameless = !t->flat;
  const int points = (int)dataset->dimension_count - 1;
  int faces = -1, time = -1;
  if (t->flat && fg__dataset_add_dimension(dataset, "cell", t->cells))
    faces = (int)dataset->dimension_count - 1;
  if (t->times > 1 && fg__dataset_add_dimension(dataset, "time", t->times)) {
    time = (int)dataset->dimension_count - 1;
    double *times = fg__allocate(t->times, sizeof *times);
    for (size_t i = 0; i < t->times && times; ++i)
      times[i] = r->zone[i * t->zones].time;
    if (!add(dataset, s, "time", times, time, -1))
      return false;
  }
  for (int v = 0; v < r->variables; ++v) {
    const bool place = v == t->place[0] || v == t->place[1] || v == t->place[2];
    const int along = fg__zone_is_centred(&r->zone[0], v) ? faces : points;
    const bool timed = time >= 0 && !place;
    if (along < 0)
      continue; /* at the cells of a volume */
    fg__variable *added =
        add(dataset, s, r->column[v].name, gather(r, t, v, timed ? t->times : 1),
            timed ? time : along, timed ? along : -1);
    const char *units = r->column[v].units;
    if (!added ||
        (units[0] && fg__variable_add_text(added, "units", units, strlen(units))))
      return false;
  }
  return !t->flat || add_mesh(dataset, s, r, t, faces);
}

fg_status fg__zones_add(fg__dataset *dataset, const fg__source *source,
                        const fg__tecplot *r)
{
  total t;
  fg_status status = find_total(&t, r);
  if (status == FG_STATUS_OK)
    status = fg__dataset_begin(dataset, r->context, r->path, source->size, &DECODER);
  if (status != FG_STATUS_OK)
    return status;
  return add_variables(dataset, dataset->file[0].state, r, &t)
             ? FG_STATUS_OK
             : fg__fail_memory(r->context, "zones", t.points * sizeof(double));
}
