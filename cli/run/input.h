/* Input of a run: the field, and the evolution on it. */
#ifndef RUN_INPUT_H
#define RUN_INPUT_H

#include "run/run.h"

/* Reads this rank's slab of the field, of an input that is perhaps open, and checks that
 * the settings apply to its dimension. Returns an exit code of this rank. */
int input_read(cli_run *run);

/* Joins the slabs of all ranks to one field; rank 0 prints which time and level was read,
 * if there are several. Closes the input. Collective. Returns an exit code, the same on
 * all. */
int input_join(cli_run *run);

/* Creates the run of scales, with the energy of the --energy file if there is one.
 * Collective. Returns an exit code, the same on all. */
int input_create_scales(cli_run *run, fg_run_options *options);

/* Prints to stderr "mesh 512 x 512 cells". */
void input_print_cells(int dimension, const int cells[3]);

#endif
