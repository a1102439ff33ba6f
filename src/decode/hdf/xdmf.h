/* XDMF: markup that describes grids, and names their arrays or holds them. */
#ifndef FG__XDMF_H
#define FG__XDMF_H

#include "decode/hdf/hdf.h"
#include "decode/vtk/document.h"

enum { FG__XDMF_WORD = 256 };

/* The value of an attribute that older files call `before` (NULL: they do not), without
 * blanks at its ends; false, and `otherwise`, where there is none. */
bool fg__xdmf_word(char out[FG__XDMF_WORD], fg__vtk *vtk, const xmlNode *node,
                   const char *name, const char *before, const char *otherwise);

/* Whole numbers of an attribute, at most `capacity`; returns how many. */
int fg__xdmf_lengths(size_t *out, int capacity, fg__vtk *vtk, const xmlNode *node,
                     const char *name);

/* Child `number` of that name, also of those that the parent includes from elsewhere, or
 * what that child refers to; *out is NULL where there is none. FILE_FORMAT, MEMORY. */
fg_status fg__xdmf_child(const xmlNode **out, fg__vtk *vtk, const xmlNode *parent,
                         const char *name, int number);

/* items.c. Reads the numbers of a DataItem into memory that is allocated, within
 * fg__hdf.room; end with free. FILE_FORMAT, UNSUPPORTED, FILE_ACCESS, MEMORY. */
fg_status fg__xdmf_create(double **out, size_t *count, fg__vtk *vtk, const xmlNode *item);

/* Adds an array of samples, which are read when they are needed. */
fg_status fg__xdmf_add_array(fg__vtk *vtk, const xmlNode *item, const char *name,
                             fg__vtk_place place, size_t tuples);

/* mesh.c. Adds a Uniform grid as a piece. */
fg_status fg__xdmf_read_uniform(fg__vtk *vtk, const xmlNode *grid);

#endif
