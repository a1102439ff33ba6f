/* Starting MPI for a program that does not know of it. */
#ifndef FG__MESSAGE_PASSING_H
#define FG__MESSAGE_PASSING_H

#include "base/context.h"

/* Initialises MPI and p4est's own layer once a process, quietly, unless the caller has
 * done so; MPI is then finalised when the process ends. MPI. */
fg_status fg__message_passing_start(fg_context *context);

#endif
