/* The decoders: each opens a file and adds what it holds to a dataset, which has to be
 * closed also after a failure. They are declared here without the libraries that they
 * need, so that one table has them all (read/registry.c). */
#ifndef FG__OPENERS_H
#define FG__OPENERS_H

#include "dataset/dataset.h"
#include "decode/signature.h"
#include "decode/source.h"
#include "flowgrain/field.h"

/* options: NULL for none. FILE_FORMAT, UNSUPPORTED, ARGUMENT, FILE_ACCESS, MEMORY. */
typedef fg_status fg__opener(fg__dataset *data, fg_context *context,
                             const fg__source *source, const fg_read_options *options);

/* All of a file whatever the options; may be called again to add a file. */
fg__opener fg__nc_open, fg__grib_open;

/* The columns of a table, along one dimension, the rows'; those without a header are
 * called by their numbers from 1. */
fg__opener fg__table_open;

/* Arrays, along dimensions that have no names; those of one length are one. An array
 * whose first or last axis counts two components, or three of a volume, and complex
 * numbers are also there by components; the only one with four or six columns by columns,
 * called by their numbers from 1. */
fg__opener fg__numpy_open;

/* What a file holds of the time and of the block that the options name: else the first
 * time, and all blocks. */
fg__opener fg__exodus_open, fg__vtk_open, fg__vtk_open_legacy, fg__vtkhdf_open,
    fg__xdmf_open;

/* Whether bytes begin such a file; a table is text, but no markup. */
bool fg__is_npy(const unsigned char *bytes, size_t size);
bool fg__is_npz(const unsigned char *bytes, size_t size);
bool fg__is_table(const unsigned char *bytes, size_t size);

#endif
