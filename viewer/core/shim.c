/* What JavaScript calls of flowgrain_core: a field and its scales in one object, whose
 * results lie in tables of numbers that JavaScript copies (viewer/src/core.js). */
#include <flowgrain/flowgrain.h>

#include "icon/icons.h"
#include "icon/row.h"

#include <stdlib.h>
#include <string.h>

#define SHIM(name) __attribute__((export_name(#name))) name

/* A row of the table of arrows; src/core.js has the same list. */
enum {
  KIND,
  CLUSTER,
  ID,
  PARENT,
  NUMBERS, /* icon/row.h; its points follow those of the row before, in their own table */
  VERTICES = NUMBERS + FG__ROW_COLUMNS, /* how many; they follow likewise */
  COLUMNS
};

/* What a row holds of an arrow that is given; src/options.js has the same list. */
enum {
  GIVEN_ID,
  GIVEN_SPEED,
  GIVEN_CENTER,
  GIVEN_SEED = GIVEN_CENTER + 2,
  GIVEN_WAY = GIVEN_SEED + 2,
  GIVEN_COLUMNS = GIVEN_WAY + 2
};

typedef struct shim_scales {
  fg_context *context;
  fg_field *field;
  fg_run *run;             /* NULL: arrows are placed without an evolution */
  fg_placement *placement; /* then */
  fg_icons *finer;
  fg_icons *first; /* of the first scale, where they are given; else NULL */
  int numbers[FG_MOST_SCALES], count, next;
  fg_density *regions;       /* what placed arrows stand for, when asked for */
  const fg_density *density; /* of the present scale, or NULL */
  fg_step step;
  double speeds[2];
  int arrows, clusters, dropped;
  double *rows, (*points)[2], (*vertices)[2];
  int *parents; /* of the scale before */
  int parent_count;
} shim_scales;

typedef struct shim_input {
  int width, height;
  double *x, *y;
  float *u, *v;
  unsigned char *valid; /* or NULL */
  double period[2];
  int degrees; /* axes are longitude and latitude */
} shim_input;

typedef struct shim_options {
  int clusters, even, effort, fair, nodes;
  double seed, anisotropy, coverage;
} shim_options;

static void clear_tables(shim_scales *s)
{
  fg_density_destroy(s->regions);
  free(s->rows);
  free(s->points);
  free(s->vertices);
  free(s->parents);
  s->regions = NULL;
  s->density = NULL;
  s->rows = NULL;
  s->points = s->vertices = NULL;
  s->parents = NULL;
  s->arrows = s->parent_count = 0;
}

/* Frees what scales_open gave; NULL is accepted. */
void SHIM(scales_close)(shim_scales *s)
{
  if (!s)
    return;
  clear_tables(s);
  fg_icons_destroy(s->finer);
  fg_placement_destroy(s->placement);
  fg_run_destroy(s->run);
  fg_icons_destroy(s->first);
  fg_field_destroy(s->field);
  fg_context_destroy(s->context);
  free(s);
}

/* An object without anything in it: only its message may be asked for, and its opening
 * begun. NULL: no memory. */
shim_scales *SHIM(scales_create)(void)
{
  shim_scales *s = calloc(1, sizeof *s);
  if (s && fg_context_create(&s->context)) {
    free(s);
    s = NULL;
  }
  return s;
}

static fg_icon given_icon(const double *row, double seed[2][3])
{
  fg_icon icon = {.id = (int)row[GIVEN_ID],
                  .speed = row[GIVEN_SPEED],
                  .point_count = 2,
                  .points = (const double(*)[3])seed};
  for (int k = 0; k < 2; ++k) {
    icon.center[k] = row[GIVEN_CENTER + k];
    icon.way[k] = row[GIVEN_WAY + k];
    seed[0][k] = seed[1][k] = icon.seed[k] = row[GIVEN_SEED + k];
  }
  return icon;
}

/* Gives the arrows of the first scale before scales_open, a row for each. Their lines are
 * not needed, and the first scale has none. Returns a status. */
int SHIM(scales_give_first)(shim_scales *s, const double *rows, int count)
{
  fg_status status = fg__icons_create_empty(&s->first, s->context);
  int last = 0;
  for (int n = 0; n < count && !status; ++n) {
    double seed[2][3] = {{0.0}};
    const fg_icon icon = given_icon(rows + (size_t)n * GIVEN_COLUMNS, seed);
    status = fg__icons_add(s->first, s->context, &icon);
    last = icon.id > last ? icon.id : last;
  }
  if (!status)
    fg__icons_set_next_id(s->first, last + 1);
  return (int)status;
}

static fg_status make_field(shim_scales *s, const shim_input *in)
{
  return fg_field_create(
      &s->field, s->context,
      &(fg_field_arrays){.dimension = 2,
                         .size = {in->width, in->height},
                         .axis = {in->x, in->y},
                         .period = {in->period[0], in->period[1]},
                         .velocity = {in->u, in->v},
                         .valid = in->valid,
                         .scale = in->degrees ? FG_SCALE_GEO : FG_SCALE_PLAIN});
}

static fg_status begin(shim_scales *s, const shim_options *o)
{
  const fg_placement_options placement = {.lengths =
                                              o->fair ? FG_LENGTHS_FAIR : FG_LENGTHS_FREE,
                                          .effort = (fg_effort)o->effort};
  if (o->even && !o->clusters && s->count && !s->first)
    return fg_placement_create(&s->placement, s->context, s->field, &placement);
  return fg_run_create(
      &s->run, s->context, s->field,
      &(fg_run_options){.kind = o->clusters ? FG_RUN_CLUSTERS : FG_RUN_ARROWS,
                        .numbers = s->numbers,
                        .count = s->count,
                        .even_start = o->even,
                        .first = s->first,
                        .placement = placement,
                        .evolution = {.nodes = o->nodes,
                                      .seed = (uint64_t)o->seed,
                                      .anisotropy = o->anisotropy,
                                      .coverage = o->coverage,
                                      .threads = 1}});
}

/* Copies a field and begins its scales of these numbers. Returns a status. */
int SHIM(scales_open)(shim_scales *s, int width, int height, double *x, double *y,
                      float *u, float *v, unsigned char *valid, double period_x,
                      double period_y, int degrees, const int *numbers, int count,
                      int clusters, int even, int effort, int fair, int nodes,
                      double seed, double anisotropy, double coverage)
{
  if (count > FG_MOST_SCALES)
    return FG_STATUS_ARGUMENT;
  memcpy(s->numbers, numbers, (size_t)count * sizeof *numbers);
  s->count = count;
  fg_status status = make_field(
      s, &(shim_input){width, height, x, y, u, v, valid, {period_x, period_y}, degrees});
  if (!status)
    status = begin(s, &(shim_options){clusters, even, effort, fair, nodes, seed,
                                      anisotropy, coverage});
  return (int)status;
}

static void fill_row(double *row, const fg_icon *icon)
{
  row[KIND] = icon->kind;
  row[CLUSTER] = icon->cluster;
  row[ID] = icon->id;
  row[PARENT] = icon->parent;
  fg__icon_row(row + NUMBERS, icon);
}

static fg_status add_outline(shim_scales *s, int row, const fg_icon *icon, size_t *used)
{
  double(*polygon)[2] = NULL;
  int count = 0;
  fg_status status = fg_icon_outline(icon, &polygon, &count);
  if (status == FG_STATUS_ARGUMENT) /* it was given, without a line */
    return FG_STATUS_OK;
  if (status)
    return status;
  void *grown = realloc(s->vertices, (*used + (size_t)count + 1) * sizeof *s->vertices);
  if (!grown) {
    free(polygon);
    return FG_STATUS_MEMORY;
  }
  s->vertices = grown;
  memcpy(s->vertices + *used, polygon, (size_t)count * sizeof *polygon);
  free(polygon);
  s->rows[row * COLUMNS + VERTICES] = count;
  *used += (size_t)count;
  return FG_STATUS_OK;
}

static fg_status fill_tables(shim_scales *s, const fg_icons *icons)
{
  size_t points = 0, vertices = 0;
  s->arrows = fg_icons_count(icons);
  s->clusters = fg_icons_clusters(icons);
  s->dropped = fg_icons_dropped(icons);
  fg_icons_speed_range(s->speeds, icons);
  for (int n = 0; n < s->arrows; ++n)
    points += (size_t)fg_icons_at(icons, n)->point_count;
  s->rows = calloc((size_t)s->arrows * COLUMNS + 1, sizeof *s->rows);
  s->points = calloc(points + 1, sizeof *s->points);
  if (!s->rows || !s->points)
    return FG_STATUS_MEMORY;
  points = 0;
  for (int n = 0; n < s->arrows; ++n) {
    const fg_icon *icon = fg_icons_at(icons, n);
    fill_row(s->rows + (size_t)n * COLUMNS, icon);
    for (int i = 0; i < icon->point_count; ++i, ++points) {
      s->points[points][0] = icon->points[i][0];
      s->points[points][1] = icon->points[i][1];
    }
    fg_status status = add_outline(s, n, icon, &vertices);
    if (status)
      return status;
  }
  return FG_STATUS_OK;
}

static fg_status fill_parents(shim_scales *s, const fg_icons *finer)
{
  int count = finer ? fg_icons_count(finer) : 0;
  s->parents = calloc((size_t)count + 1, sizeof *s->parents);
  if (!s->parents)
    return FG_STATUS_MEMORY;
  for (int n = 0; n < count; ++n)
    s->parents[n] = fg_icons_at(finer, n)->parent;
  s->parent_count = count;
  return FG_STATUS_OK;
}

static fg_status next_of_run(shim_scales *s, int *has)
{
  const fg_run_scale *scale = NULL;
  fg_status status = fg_run_next(&scale, s->run);
  *has = scale != NULL;
  if (status || !scale)
    return status;
  s->density = scale->density;
  s->step = scale->step;
  status = fill_tables(s, scale->icons);
  return status ? status : fill_parents(s, scale->finer);
}

static fg_status next_placed(shim_scales *s, int *has)
{
  fg_icons *icons = NULL;
  *has = s->next < s->count;
  if (!*has)
    return FG_STATUS_OK;
  fg_status status = fg_run_place(&icons, s->context, s->placement, s->numbers[s->next++],
                                  NULL, true, s->finer);
  if (!status)
    status = fill_tables(s, icons);
  if (!status)
    status = fill_parents(s, s->finer);
  fg_icons_destroy(s->finer);
  s->finer = icons;
  return status;
}

/* Goes on to the next scale; *has is 0 after the last. Returns a status. */
int SHIM(scales_next)(shim_scales *s, int *has)
{
  clear_tables(s);
  *has = 0;
  return (int)(s->run ? next_of_run(s, has) : next_placed(s, has));
}

/* Lets the density and its labels be the parts that placed arrows stand for, where no
 * evolution has given any. Returns a status. */
int SHIM(scales_find_regions)(shim_scales *s)
{
  fg_status status = FG_STATUS_OK;
  if (s->placement && !s->density)
    status = fg_placement_regions(&s->regions, s->placement);
  if (s->regions)
    s->density = s->regions;
  return (int)status;
}

/* The tables of the present scale, until the next call of scales_next. */
const double *SHIM(scales_rows)(const shim_scales *s)
{
  return s->rows;
}
const double *SHIM(scales_points)(const shim_scales *s)
{
  return s->points[0];
}
const double *SHIM(scales_vertices)(const shim_scales *s)
{
  return s->vertices ? s->vertices[0] : NULL;
}
const int *SHIM(scales_parents)(const shim_scales *s)
{
  return s->parents;
}

/* Numbers of the present scale, in the order of src/core.js. */
void SHIM(scales_facts)(const shim_scales *s, double out[16])
{
  const fg_density_arrays *d = s->density ? fg_density_contents(s->density) : NULL;
  const double facts[] = {s->arrows,
                          s->clusters,
                          s->dropped,
                          s->speeds[0],
                          s->speeds[1],
                          s->step.time,
                          (double)s->step.step,
                          s->parent_count,
                          d ? d->nodes[0] : 0,
                          d ? d->nodes[1] : 0,
                          d ? d->origin[0] : 0.0,
                          d ? d->origin[1] : 0.0,
                          d ? d->spacing[0] : 0.0,
                          d ? d->spacing[1] : 0.0};
  memcpy(out, facts, sizeof facts);
}

const float *SHIM(scales_density)(const shim_scales *s)
{
  return s->density ? fg_density_contents(s->density)->u : NULL;
}

const int *SHIM(scales_labels)(const shim_scales *s)
{
  return s->density ? fg_density_labels(s->density) : NULL;
}

const char *SHIM(scales_message)(const shim_scales *s)
{
  return fg_context_message(s->context);
}

const char *SHIM(scales_hint)(const shim_scales *s)
{
  return fg_context_hint(s->context);
}

const char *SHIM(version)(void)
{
  return fg_version();
}

/* Memory for what JavaScript passes. */
void *SHIM(take)(size_t size)
{
  return malloc(size ? size : 1);
}
void SHIM(give)(void *memory)
{
  free(memory);
}
