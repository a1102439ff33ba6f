/* Values at the nodes and of the elements. */
#include "read/exodus/exodus.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { MOST_VARIABLES = 500 };

/* Values of one variable at all nodes: a variable for each since 1998, before that one
 * for all. */
static fg_status read_nodal(double *out, const fg__exodus *e, size_t number, size_t time)
{
  char name[32];
  snprintf(name, sizeof name, "vals_nod_var%zu", number + 1);
  const fg__variable *v = fg__dataset_find(&e->file, name);
  const size_t first[3] = {time, number, 0}, count[3] = {1, 1, e->points};
  const size_t two_first[2] = {time, 0}, two_count[2] = {1, e->points};
  if (v)
    return fg__exodus_numbers(out, e, v, two_first, two_count, 2);
  v = fg__dataset_find(&e->file, "vals_nod_var");
  return v ? fg__exodus_numbers(out, e, v, first, count, 3)
           : fg__fail(e->file.context, FG_STATUS_FILE_FORMAT, "%s: has no variable '%s'",
                      e->file.file[0].path, name);
}

/* Values of one variable of all chosen blocks' elements; NaN in blocks without it. */
static fg_status read_of_elements(double *out, const fg__exodus *e, size_t number,
                                  size_t time)
{
  fg_status status = FG_STATUS_OK;
  for (size_t b = 0; b < e->blocks && status == FG_STATUS_OK; ++b) {
    const fg__exodus_block *block = &e->block[b];
    const size_t first[2] = {time, 0}, count[2] = {1, block->cells};
    char name[64];
    snprintf(name, sizeof name, "vals_elem_var%zueb%d", number + 1, block->number);
    const fg__variable *v = fg__dataset_find(&e->file, name);
    if (v)
      status = fg__exodus_numbers(out, e, v, first, count, 2);
    for (size_t c = 0; c < block->cells && !v; ++c)
      out[c] = (double)NAN;
    out += block->cells;
  }
  return status;
}

static bool is_velocity(const char *name)
{
  return strncasecmp(name, "vel", 3) == 0;
}

/* Beside a velocity, what else has components along the axes, displacements and
 * accelerations, is none. */
static void mark_others(fg__vtk *vtk)
{
  bool found = false;
  for (size_t i = vtk->pieces[0].first_array; i < vtk->array_count; ++i)
    found = found || is_velocity(vtk->arrays[i].name);
  for (size_t i = vtk->pieces[0].first_array; i < vtk->array_count && found; ++i)
    vtk->arrays[i].no_velocity = !is_velocity(vtk->arrays[i].name);
}

static fg_status add_named(fg__vtk *vtk, const fg__exodus *e, fg__vtk_place place,
                           size_t time)
{
  const bool nodal = place == FG__VTK_POINTS;
  const size_t count = fg__exodus_length(e, nodal ? "num_nod_var" : "num_elem_var");
  fg_status status = FG_STATUS_OK;
  if (count > MOST_VARIABLES)
    return fg__fail(e->file.context, FG_STATUS_UNSUPPORTED,
                    "%s: %zu variables; at most %d can be read", e->file.file[0].path,
                    count, MOST_VARIABLES);
  for (size_t n = 0; n < count && status == FG_STATUS_OK; ++n) {
    char name[FG__EXODUS_NAME];
    void *values = NULL;
    fg__exodus_text(name, e, nodal ? "name_nod_var" : "name_elem_var", n);
    status = fg__exodus_add(&values, vtk, name, place, FG__VTK_FLOAT64, 1,
                            nodal ? e->points : e->cells);
    if (status == FG_STATUS_OK)
      status = (nodal ? read_nodal : read_of_elements)(values, e, n, time);
  }
  return status;
}

fg_status fg__exodus_add_variables(fg__vtk *vtk, const fg__exodus *e, size_t time)
{
  fg_status status = add_named(vtk, e, FG__VTK_POINTS, time);
  if (status == FG_STATUS_OK)
    status = add_named(vtk, e, FG__VTK_CELLS, time);
  if (status == FG_STATUS_OK)
    mark_others(vtk);
  return status;
}
