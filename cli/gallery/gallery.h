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

/* Commands are words after `flowgrain`, with a space between; files of data/ that they
 * read stand in the gallery's folder. */
typedef struct gallery_figure {
  int number; /* the paper's */
  int last;   /* of those that are one here; 0: the same */
  const char *title;
  const char *paper;                     /* what the paper's figure shows */
  const char *differs;                   /* from it, and why; NULL: nothing to say */
  void (*draw)(FILE *svg);               /* a diagram: fig-NN.svg */
  const char *command[GALLERY_COMMANDS]; /* up to the first NULL */
  gallery_picture picture[GALLERY_PICTURES];
  int row[GALLERY_ROWS]; /* pictures in each row on the page; all 0: one row */
} gallery_figure;

extern const gallery_figure gallery_figures[];
extern const int gallery_figure_count;

/* Files of data/ that figures read. */
extern const char *const gallery_data[];
extern const int gallery_data_count;

/* Whether a figure is the one of that number; all are, when it is 0. */
bool gallery_shows(const gallery_figure *figure, int number);

/* The page that shows them, all or the one of the settings: what is there of their
 * pictures. */
void gallery_print_page(FILE *page, const gallery_settings *settings);

/* The double well, and the substeps of the theta-scheme. */
void gallery_draw_double_well(FILE *svg);
void gallery_draw_substeps(FILE *svg);

#endif
