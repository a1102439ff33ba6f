/* What lists of cells and their interpolation share. */
#ifndef FG__CELL_TYPES_H
#define FG__CELL_TYPES_H

/* VTK's number of the only type whose faces are listed (vtkCellType.h). */
enum { FG__POLYHEDRON = 42 };

/* What to do about cells that cannot be read. */
#define FG__RESAMPLE                                                                     \
  "resample it to an image, with ParaView's filter Resample To Image or "                \
  "vtkResampleToImage, and save that as .vti"

#endif
