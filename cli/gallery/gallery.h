/* The figures of Garcke et al. (2000), each made by commands of this program. */
#ifndef GALLERY_GALLERY_H
#define GALLERY_GALLERY_H

#include <stdio.h>

#include "option/settings.h"

typedef struct gallery_picture {
  const char *path; /* in the gallery's folder */
  const char *caption;
} gallery_picture;

enum { GALLERY_COMMANDS = 8, GALLERY_PICTURES = 8, GALLERY_ROWS = 3 };

/* Commands are words after `flowgrain`, separated by spaces. Files of data/ that they
 * read are in the gallery's folder. */
typedef struct gallery_figure {
  int number; /* the paper's */
  int last;   /* last number of those that are one figure here; 0: the same */
  const char *title;
  const char *paper;       /* what the paper's figure shows */
  const char *differs;     /* difference from the paper and its reason; NULL: none */
  void (*draw)(FILE *svg); /* a diagram: fig-NN.svg */
  const char *command[GALLERY_COMMANDS]; /* up to the first NULL */
  gallery_picture picture[GALLERY_PICTURES];
  int row[GALLERY_ROWS]; /* pictures in each row on the page; all 0: one row */
} gallery_figure;

extern const gallery_figure gallery_figures[];
extern const int gallery_figure_count;

/* Files of data/ that figures read. */
extern const char *const gallery_data[];
extern const int gallery_data_count;

/* Whether the number selects the figure; 0 selects all. */
bool gallery_shows(const gallery_figure *figure, int number);

/* Prints the page with the pictures that exist, of all figures or of the chosen one. */
void gallery_print_page(FILE *page, const gallery_settings *settings);

/* The double well with the energies over time, and the substeps of the theta-scheme. */
void gallery_draw_energy(FILE *svg);
void gallery_draw_substeps(FILE *svg);

#endif
