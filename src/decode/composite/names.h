/* The files that a VTK XML file names. */
#ifndef FG__VTK_NAMES_H
#define FG__VTK_NAMES_H

#include "decode/vtk/document.h"

/* A file that is named, and what of. */
typedef struct fg__vtk_name {
  char *file;
  char *block; /* names of the blocks that it is in, with slashes between */
  double time;
} fg__vtk_name;

typedef struct fg__vtk_names {
  fg__vtk_name *entry;
  size_t count, capacity;
} fg__vtk_names;

void fg__vtk_names_clear(fg__vtk_names *names);

/* Add what an element names: Piece elements with a Source; DataSet elements with a file,
 * below blocks in blocks, or each with a time. FILE_FORMAT, UNSUPPORTED (more than 64
 * blocks in each other), MEMORY. */
fg_status fg__vtk_names_of_pieces(fg__vtk_names *out, fg__vtk *vtk, const xmlNode *grid);
fg_status fg__vtk_names_of_blocks(fg__vtk_names *out, fg__vtk *vtk,
                                  const xmlNode *blocks);
fg_status fg__vtk_names_of_times(fg__vtk_names *out, fg__vtk *vtk,
                                 const xmlNode *collection);

/* Adds one, whose `file` is taken over. */
fg_status fg__vtk_names_add(fg__vtk_names *names, fg__vtk *vtk, char *file,
                            const char *block, double time);

/* series.c. Adds those that a list in JSON names; without a time it is the place in it.
 * FILE_FORMAT, MEMORY. */
fg_status fg__vtk_names_of_series(fg__vtk_names *names, fg__vtk *vtk,
                                  const fg__source *source);

/* Keeps the files of one of the times, which ascend from 0 on and become the dataset's.
 * ARGUMENT, MEMORY. */
fg_status fg__vtk_names_choose_time(fg__dataset *data, fg__vtk_names *names,
                                    const char *path, int wanted);

/* Keeps the files of a block: its own name, its path, or one that it is in; NULL: all.
 * ARGUMENT. */
fg_status fg__vtk_names_choose_block(fg__vtk_names *names, fg_context *context,
                                     const char *path, const char *wanted);

/* The path of a file that the file at `path` names, in its folder or below by its words
 * and by where links lead; end with free, also after a failure. UNSUPPORTED, MEMORY. */
fg_status fg__vtk_names_path(char **out, fg_context *context, const char *path,
                             const char *name);

#endif
