/* VTKHDF files: images, unstructured grids and polygons in parts, at several times.
 * Format: VTKHDF file format specification 2.6, Kitware. */
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "decode/hdf/hdf.h"

enum {
  MOST_PARTS = 1 << 20,
  GROUP = 7 /* letters of "VTKHDF/" */
};

/* Where the lists of cells are, and of polygons those of each kind, in the order of the
 * cells' data with VTK's numbers of their types. */
static const struct {
  const char *group;
  int type;
} LISTS[2][FG__VTK_LISTS] = {
    {{"", 0}}, {{"Vertices/", 2}, {"Lines/", 4}, {"Polygons/", 7}, {"Strips/", 6}}};

/* The reading of a file. */
typedef struct vtkhdf {
  fg__vtk *vtk;
  const fg__dataset *data;
  const fg__variable *group; /* attributes of VTKHDF */
  size_t step, steps;        /* 0: no times */
} vtkhdf;

static const fg__variable *find(const vtkhdf *h, const char *group, const char *name)
{
  char whole[FG__NAME_BYTES];
  snprintf(whole, sizeof whole, "VTKHDF/%s%.400s", group, name);
  return fg__hdf_find(h->data, whole);
}

static size_t length_of(const vtkhdf *h, const fg__variable *v, int k)
{
  return k < v->rank ? h->data->dimensions[v->dimension[k]].length : 1;
}

/* Number `index` of a variable that counts or says where something begins. */
static fg_status read_index(size_t *out, const vtkhdf *h, const fg__variable *v,
                            size_t index)
{
  size_t count = 0;
  double number = -1.0;
  fg_status status = fg__hdf_count(&count, v);
  if (status == FG_STATUS_OK && index < count)
    status = fg__hdf_read(&number, v, index, 1);
  if (status != FG_STATUS_OK)
    return status;
  if (!(number >= 0.0 && number <= 9e15))
    return fg__fail(h->vtk->context, FG_STATUS_FILE_FORMAT,
                    "%s: '%.100s' has %zu numbers, and at %zu no count but %g",
                    h->vtk->path, v->name, count, index, number);
  *out = (size_t)number;
  return FG_STATUS_OK;
}

/* The same of a variable that must be there. */
static fg_status read_count(size_t *out, const vtkhdf *h, const char *group,
                            const char *name, size_t index)
{
  const fg__variable *v = find(h, group, name);
  return v ? read_index(out, h, v, index)
           : fg__fail(h->vtk->context, FG_STATUS_FILE_FORMAT, "%s: has no VTKHDF/%s%s",
                      h->vtk->path, group, name);
}

/* What the chosen step begins with, number `of` of `each` that a step has; without times,
 * or where nothing is said, *out is left as it is. */
static fg_status read_step(size_t *out, const vtkhdf *h, const char *group,
                           const char *name, size_t each, size_t of)
{
  const fg__variable *v = h->steps > 0 ? find(h, group, name) : NULL;
  return v ? read_index(out, h, v, h->step * each + of) : FG_STATUS_OK;
}

/* Adds the samples of points or cells, which begin `before` tuples behind where the step
 * does; `begin` is that where nothing else is said. image: how many an image has, whose
 * arrays have a dimension of times; of others 0. */
static fg_status add_samples(const vtkhdf *h, fg__vtk_place place, size_t begin,
                             size_t before, size_t image)
{
  const char *group = place == FG__VTK_POINTS ? "PointData/" : "CellData/";
  const char *steps =
      place == FG__VTK_POINTS ? "Steps/PointDataOffsets/" : "Steps/CellDataOffsets/";
  const size_t length = strlen(group);
  fg_status status = FG_STATUS_OK;
  for (size_t i = 0; i < h->data->variable_count && status == FG_STATUS_OK; ++i) {
    const fg__variable *v = &h->data->variables[i];
    size_t all = 0, first = image > 0 ? h->step : begin;
    if (strncmp(v->name, "VTKHDF/", GROUP) != 0 ||
        strncmp(v->name + GROUP, group, length) != 0 || !fg__is_number(v))
      continue;
    status = fg__hdf_count(&all, v);
    if (status == FG_STATUS_OK)
      status = read_step(&first, h, steps, v->plain_name, 1, 0);
    size_t components = length_of(h, v, 1);
    if (image > 0) {
      const size_t times = h->steps > 0 ? length_of(h, v, 0) : 1;
      components = times > 0 ? all / times / image : 0;
      if (components * image * times != all || components == 0)
        status =
            fg__fail(h->vtk->context, FG_STATUS_FILE_FORMAT,
                     "%s: '%.100s' has %zu numbers, for %zu of an image at %zu times",
                     h->vtk->path, v->name, all, image, times);
      first *= image;
    }
    if (status == FG_STATUS_OK && components <= INT_MAX)
      status = fg__hdf_add_array(h->vtk, v, v->plain_name, place, (int)components,
                                 (first + before) * components);
    if (status != FG_STATUS_OK)
      break;
    const fg__variable *said = fg__group_of(v);
    char name[FG__TEXT_BYTES];
    fg__vtk_array *array = &h->vtk->arrays[h->vtk->array_count - 1];
    if (!h->vtk->vectors[place] && fg__attribute_text(said, "Vectors", name, sizeof name))
      h->vtk->vectors[place] = fg__copy_text(name);
    static const char *const others[] = {"Normals", "TCoords", "Tangents"};
    for (int k = 0; k < 3; ++k)
      if (fg__attribute_text(said, others[k], name, sizeof name) &&
          strcmp(name, v->plain_name) == 0)
        array->no_velocity = true;
  }
  return status;
}

/* An image is one piece. */
static fg_status read_image(const vtkhdf *h)
{
  static const double straight[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  fg__vtk *vtk = h->vtk;
  double extent[6], origin[3] = {0, 0, 0}, spacing[3] = {1, 1, 1};
  size_t points = 0, cells = 0;
  bool good = fg__attribute_numbers(h->group, "WholeExtent", extent, 6) == 6;
  memcpy(vtk->direction, straight, sizeof straight);
  fg__attribute_numbers(h->group, "Origin", origin, 3);
  fg__attribute_numbers(h->group, "Spacing", spacing, 3);
  fg__attribute_numbers(h->group, "Direction", vtk->direction, 9);
  for (int k = 0; k < 3 && good; ++k) {
    good = extent[2 * k] >= -INT_MAX / 2 && extent[2 * k] <= extent[2 * k + 1] &&
           extent[2 * k + 1] <= INT_MAX / 2 && isfinite(origin[k]) &&
           (spacing[k] > 0.0 || extent[2 * k] >= extent[2 * k + 1]);
    if (!good)
      break;
    vtk->extent[2 * k] = (int)extent[2 * k];
    vtk->extent[2 * k + 1] = (int)extent[2 * k + 1];
    vtk->origin[k] = origin[k];
    vtk->spacing[k] = spacing[k];
  }
  for (int k = 0; k < 9; ++k)
    if (vtk->direction[k] > straight[k] || vtk->direction[k] < straight[k])
      vtk->turned = true;
  vtk->kind = vtk->turned ? FG__VTK_CURVILINEAR : FG__VTK_ALONG_AXES;
  if (!good || !fg__vtk_count(&points, vtk->extent, FG__VTK_POINTS) ||
      !fg__vtk_count(&cells, vtk->extent, FG__VTK_CELLS))
    return fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                    "%s: an image without a good WholeExtent, Origin and Spacing",
                    vtk->path);
  fg_status status = fg__vtk_add_piece(vtk, vtk->extent);
  if (status == FG_STATUS_OK)
    status = add_samples(h, FG__VTK_POINTS, 0, 0, points);
  if (status == FG_STATUS_OK)
    status = add_samples(h, FG__VTK_CELLS, 0, 0, cells);
  return status == FG_STATUS_OK ? fg__vtk_end_piece(vtk) : status;
}

/* What the parts before the one that is read have, and what the step begins with. */
typedef struct sums {
  size_t part, parts;                /* of the file */
  size_t point, points;              /* where the step begins, and after it */
  size_t cell[FG__VTK_LISTS], cells; /* of each list, where it is; all after */
  size_t cell_begin;                 /* of all lists */
  size_t corner[FG__VTK_LISTS];
} sums;

static fg_status add_mesh_array(size_t *out, const vtkhdf *h, const char *group,
                                const char *name, int components, size_t first)
{
  const fg__variable *v = find(h, group, name);
  *out = h->vtk->array_count;
  return v ? fg__hdf_add_array(h->vtk, v, name, FG__VTK_COORDINATES, components, first)
           : fg__fail(h->vtk->context, FG_STATUS_FILE_FORMAT, "%s: has no VTKHDF/%s%s",
                      h->vtk->path, group, name);
}

static fg_status read_list(const vtkhdf *h, sums *s, int k, size_t part)
{
  const char *group = LISTS[h->vtk->polygons][k].group;
  size_t cells = 0, corners = 0, ends, connectivity, types = FG__VTK_NONE;
  fg_status status = read_count(&cells, h, group, "NumberOfCells", part);
  if (status == FG_STATUS_OK)
    status = read_count(&corners, h, group, "NumberOfConnectivityIds", part);
  if (status == FG_STATUS_OK)
    status = add_mesh_array(&ends, h, group, "Offsets", 1, s->cell[k] + part);
  if (status == FG_STATUS_OK)
    status = add_mesh_array(&connectivity, h, group, "Connectivity", 1, s->corner[k]);
  if (status == FG_STATUS_OK && !h->vtk->polygons)
    status = add_mesh_array(&types, h, group, "Types", 1, s->cell[k]);
  if (status != FG_STATUS_OK)
    return status;
  fg__vtk_piece *piece = &h->vtk->pieces[h->vtk->piece_count - 1];
  fg__vtk_list *list = &piece->list[k];
  if (cells > INT_MAX || corners > INT_MAX || piece->cells > INT_MAX)
    return fg__fail(h->vtk->context, FG_STATUS_UNSUPPORTED, "%s: more than %d cells",
                    h->vtk->path, INT_MAX);
  list->cells = corners > 0 ? cells : 0;
  list->corners = connectivity;
  list->types = types;
  list->ends = ends;
  list->corner_numbers = corners;
  list->end_numbers = cells + 1;
  list->type = LISTS[h->vtk->polygons][k].type;
  piece->cells += cells;
  s->cell[k] += cells;
  s->corner[k] += corners;
  return FG_STATUS_OK;
}

static fg_status read_part(const vtkhdf *h, sums *s, size_t part)
{
  fg__vtk *vtk = h->vtk;
  size_t points = 0, positions = 0;
  fg_status status = read_count(&points, h, "", "NumberOfPoints", part);
  if (status == FG_STATUS_OK && points > INT_MAX)
    status = fg__fail(vtk->context, FG_STATUS_UNSUPPORTED, "%s: more than %d points",
                      vtk->path, INT_MAX);
  if (status == FG_STATUS_OK)
    status = fg__vtk_add_piece(vtk, vtk->extent);
  if (status == FG_STATUS_OK)
    status = add_samples(h, FG__VTK_POINTS, s->point, s->points, 0);
  if (status == FG_STATUS_OK)
    status = add_samples(h, FG__VTK_CELLS, s->cell_begin, s->cells, 0);
  if (status == FG_STATUS_OK)
    status = fg__vtk_end_piece(vtk);
  if (status == FG_STATUS_OK)
    status = add_mesh_array(&positions, h, "", "Points", 3, 3 * (s->point + s->points));
  for (int k = 0; k < (vtk->polygons ? FG__VTK_LISTS : 1) && status == FG_STATUS_OK; ++k)
    status = read_list(h, s, k, part);
  if (status != FG_STATUS_OK)
    return status;
  fg__vtk_piece *piece = &vtk->pieces[vtk->piece_count - 1];
  piece->positions = positions;
  piece->points = points;
  s->points += points;
  s->cells += piece->cells;
  if (points == 0 || piece->cells == 0)
    --vtk->piece_count; /* a process that had nothing to write */
  return FG_STATUS_OK;
}

static fg_status read_parts(const vtkhdf *h)
{
  sums s = {.part = 0};
  const size_t lists = h->vtk->polygons ? FG__VTK_LISTS : 1;
  const fg__variable *points = find(h, "", "NumberOfPoints");
  h->vtk->kind = FG__VTK_UNSTRUCTURED;
  s.parts = points ? length_of(h, points, 0) : 1;
  fg_status status = read_step(&s.part, h, "Steps/", "PartOffsets", 1, 0);
  if (status == FG_STATUS_OK)
    status = read_step(&s.parts, h, "Steps/", "NumberOfParts", 1, 0);
  if (status == FG_STATUS_OK)
    status = read_step(&s.point, h, "Steps/", "PointOffsets", 1, 0);
  for (size_t k = 0; k < lists && status == FG_STATUS_OK; ++k) {
    status = read_step(&s.cell[k], h, "Steps/", "CellOffsets", lists, k);
    if (status == FG_STATUS_OK)
      status = read_step(&s.corner[k], h, "Steps/", "ConnectivityIdOffsets", lists, k);
    s.cell_begin += s.cell[k];
  }
  if (status == FG_STATUS_OK && s.parts > MOST_PARTS)
    status = fg__fail(h->vtk->context, FG_STATUS_UNSUPPORTED, "%s: more than %d parts",
                      h->vtk->path, MOST_PARTS);
  for (size_t p = 0; p < s.parts && status == FG_STATUS_OK; ++p)
    status = read_part(h, &s, s.part + p);
  return status;
}

static fg_status choose_time(vtkhdf *h, fg__dataset *data, const fg_read_options *options)
{
  const fg__variable *v = find(h, "Steps/", "Values");
  const int wanted = options ? options->time : 0;
  if (!v)
    return FG_STATUS_OK;
  fg_status status = fg__hdf_count(&h->steps, v);
  if (status != FG_STATUS_OK || h->steps == 0 || h->steps > INT_MAX)
    return status;
  double *time = fg__allocate(h->steps, sizeof *time);
  if (!time)
    return fg__fail_memory(data->context, "times", h->steps * sizeof *time);
  status = fg__dataset_choose_time(data, h->vtk->path, time, h->steps, wanted);
  h->step = (size_t)wanted;
  return status == FG_STATUS_OK ? fg__hdf_read(time, v, 0, h->steps) : status;
}

static fg_status read_grid(const vtkhdf *h)
{
  char type[FG__TEXT_BYTES] = "";
  if (h->group)
    fg__attribute_text(h->group, "Type", type, sizeof type);
  if (strcmp(type, "ImageData") == 0)
    return read_image(h);
  h->vtk->polygons = strcmp(type, "PolyData") == 0;
  if (h->vtk->polygons || strcmp(type, "UnstructuredGrid") == 0)
    return read_parts(h);
  fg__fail(
      h->vtk->context, FG_STATUS_UNSUPPORTED,
      "%s: a VTKHDF file of type \"%.100s\"; ImageData, UnstructuredGrid and PolyData "
      "can be read",
      h->vtk->path, type);
  fg__hint(h->vtk->context, "%s", FG__RESAMPLE);
  return FG_STATUS_UNSUPPORTED;
}

fg_status fg__vtkhdf_open(fg__dataset *data, fg_context *context,
                          const fg__source *source, const fg_read_options *options)
{
  vtkhdf h = {.step = 0};
  fg__hdf *hdf;
  fg__hdf_file *file = NULL;
  fg_status status = fg__vtk_begin(&h.vtk, data, context, source);
  if (status == FG_STATUS_OK)
    status = fg__hdf_begin(&hdf, h.vtk);
  if (status == FG_STATUS_OK)
    status = fg__hdf_open(&file, h.vtk, NULL, source);
  if (status != FG_STATUS_OK)
    return status;
  h.data = &file->data;
  for (size_t i = 0; i < h.data->group_count && !h.group; ++i)
    if (fg__attribute_find(&h.data->groups[i], "Version") &&
        fg__attribute_find(&h.data->groups[i], "Type"))
      h.group = &h.data->groups[i];
  status = choose_time(&h, data, options);
  if (status == FG_STATUS_OK)
    status = read_grid(&h);
  return status == FG_STATUS_OK ? fg__vtk_fill(data, h.vtk) : status;
}
