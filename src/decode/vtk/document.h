/* The markup of VTK XML files, as libxml2 has parsed it. */
#ifndef FG__VTK_DOCUMENT_H
#define FG__VTK_DOCUMENT_H

#include "decode/vtk/vtk.h"

#include <libxml/tree.h>

bool fg__vtk_is_element(const xmlNode *node, const char *name);

/* The first child of that name; NULL for none. */
const xmlNode *fg__vtk_child(const xmlNode *parent, const char *name);

/* A copy of what libxml2 has copied, which NULL shows it could not: then vtk->exhausted
 * is set. End with free. */
char *fg__vtk_copy_of(fg__vtk *vtk, xmlChar *value);

/* A copy of what an element holds, without blanks at its ends; end with free. */
char *fg__vtk_content(fg__vtk *vtk, const xmlNode *node);

/* Copy of an attribute; NULL when it is not there. End with free. */
char *fg__vtk_attribute(fg__vtk *vtk, const xmlNode *node, const char *name);
bool fg__vtk_attribute_is(fg__vtk *vtk, const xmlNode *node, const char *name,
                          const char *expected);
fg_status fg__vtk_bad_attribute(fg__vtk *vtk, const xmlNode *node, const char *name);

/* The six whole numbers of an attribute. */
fg_status fg__vtk_read_extent(fg__vtk *vtk, const xmlNode *node, const char *name,
                              int extent[6]);

/* Adds the arrays in the child `name` of an element, if it has one. */
fg_status fg__vtk_read_arrays(fg__vtk *vtk, const xmlNode *parent, const char *name,
                              fg__vtk_place place);

/* Adds a piece with its arrays; nothing of one that is empty. */
fg_status fg__vtk_read_piece(fg__vtk *vtk, const xmlNode *node);

/* markup.c. Whether raw appended data end where the last array does. FILE_FORMAT,
 * MEMORY. */
fg_status fg__vtk_check_appended(fg__vtk *vtk);

/* Takes what is in a document apart that was parsed. */
fg_status fg__vtk_read_document(fg__vtk *vtk);

/* The extent of a grid or the whole of several, its origin, spacing and directions. */
fg_status fg__vtk_read_geometry(fg__vtk *vtk, const xmlNode *grid);

#endif
