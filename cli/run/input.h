/* What a run works on: the field of its INPUT, and the evolution over it. */
#ifndef RUN_INPUT_H
#define RUN_INPUT_H

#include "run/run.h"

/* Reads this rank's part of the field, and checks that what the settings choose can be
 * done in its dimension. Returns an exit code of this rank alone. */
int input_read(cli_run *run);

/* Makes one field of all ranks' parts; rank 0 says which time and level it is, where
 * there were several. Collective. Returns an exit code, the same on all. */
int input_join(cli_run *run);

/* Creates the run of scales, its energy read from a file where --energy names one.
 * Collective. Returns an exit code, the same on all. */
int input_create_scales(cli_run *run, fg_run_options *options);

/* To stderr: "mesh 512 x 512 cells". */
void input_print_cells(int dimension, const int cells[3]);

#endif
