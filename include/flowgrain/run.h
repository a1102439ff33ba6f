/* A run of scales: the icons of one field, from many to few. Included by flowgrain.h. */
#ifndef FLOWGRAIN_RUN_H
#define FLOWGRAIN_RUN_H

#include "flowgrain/checkpoint.h"
#include "flowgrain/placement.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum fg_run_kind {
  FG_RUN_ARROWS = 0, /* placed: exactly that number of arrows */
  FG_RUN_CLUSTERS,   /* an arrow in each cluster, at most that number of them */
  FG_RUN_TIMES       /* the same at given times, however many clusters there are */
} fg_run_kind;

enum { FG_MOST_SCALES = 64 };

/* A zero field means its default, in brackets. */
typedef struct fg_run_options {
  fg_run_kind kind;    /* [arrows] */
  const int *numbers;  /* of arrows or clusters, descending [arrows: 200, 100, 50, 25, 12,
                          in 3D 60, 25, 12; clusters: as many as can first be counted,
                          then halved down to 12] */
  const double *times; /* t of FG_RUN_TIMES, ascending: a scale is the first state at or
                          after its t */
  int count;           /* of `numbers` or `times`, FG_MOST_SCALES at most */
  fg_evolution_options evolution; /* [nodes of arrows: what the first number needs] */
  fg_placement_options placement; /* of arrows; threads [as of the evolution] */
  bool even_start; /* the first scale's arrows start from evenly distributed points [from
                      clusters] */
  const fg_icons *first; /* icons of the first scale, as many as its number, that were
                            placed before on this field or one that differs little from
                            it; they must outlive the run [placed] */
  double max_time; /* ends the run at this t; the state there is the last scale [none] */
  int64_t max_steps; /* the same at a number of steps [none] */
} fg_run_options;

/* Why a run has ended. */
typedef enum fg_run_outcome {
  FG_RUN_GO_ON = 0,  /* it has not */
  FG_RUN_ALL,        /* all scales are taken */
  FG_RUN_STATIONARY, /* the pattern no longer changes */
  FG_RUN_AT_TIME,
  FG_RUN_AT_STEPS,
  FG_RUN_STOPPED /* fg_context_stop was called */
} fg_run_outcome;

/* One scale; all is borrowed until the next call for the same run. */
typedef struct fg_run_scale {
  int index;           /* from 0, the finest */
  const int *wanted;   /* the numbers that it is the scale of: clusters can fall below
                          several at once; none where the run ended before its last
                          number */
  const double *times; /* the same of FG_RUN_TIMES, which has no numbers */
  int wanted_count;    /* of either */
  fg_step step;        /* the state of the evolution */
  const fg_density *density; /* of that state, which ranks share; of placed arrows all of
                                it on rank 0, and NULL on others */
  const fg_icons *icons;     /* NULL on ranks other than 0 */
  const fg_icons *finer;     /* of the scale before, now with their `parent`; NULL: none,
                                or not placed */
} fg_run_scale;

typedef struct fg_run fg_run;

/* Begins a run on a field, which must outlive it; `options` may be NULL. On several ranks
 * collective; arrows are then placed by rank 0, which needs the whole field. ARGUMENT
 * (numbers out of order or range; as fg_evolution_create), MEMORY, MPI. */
FG_API fg_status fg_run_create(fg_run **out, fg_context *context, const fg_field *field,
                               const fg_run_options *options);
FG_API void fg_run_destroy(fg_run *run);

/* Goes on to the next scale and makes its density and icons; *out is NULL after the last.
 * A run always ends: one whose pattern comes to rest early gives what it has, arrows as
 * many as are wanted all the same, and at later times that pattern. Collective.
 * NO_CONVERGENCE, ARGUMENT (no room for a number of arrows), MEMORY, STOPPED, MPI. */
FG_API fg_status fg_run_next(const fg_run_scale **out, fg_run *run);

/* Why the run has ended, or that it has not. */
FG_API fg_run_outcome fg_run_ended(const fg_run *run);

/* The parts of fg_run_next, for programs that do more between steps: make a step; take
 * the scales that its state is; and when the run has ended, close it and take what is
 * left. */

/* Makes a step. Collective. As fg_evolution_step; on STOPPED `step` stays what it was. */
FG_API fg_status fg_run_step(fg_step *step, fg_run *run);

/* Takes the next scale of the present state, without density and icons; false: there is
 * none (more). */
FG_API bool fg_run_take(fg_run_scale *out, fg_run *run);

/* Ends a run: the scales that were not reached become scales of its last state. Of placed
 * arrows all of them, unless the run was stopped; of clusters or times one, with as many
 * clusters as there are. */
FG_API void fg_run_close(fg_run *run);

/* The numbers wanted, descending, borrowed, zeros of FG_RUN_TIMES; the first *next of
 * them are reached. Default numbers of clusters are known once clusters are counted.
 * Returns how many. */
FG_API int fg_run_wanted(const int **wanted, int *next, const fg_run *run);

/* Share of the way to the last scale, 0 to 1, and an estimate of the seconds left,
 * negative while there is none; the number of clusters is taken to fall as t^-0.43. */
FG_API void fg_run_progress(double *share, double *seconds_left, const fg_run *run);

/* The run's evolution, borrowed: to save or describe it, or to copy its density. */
FG_API fg_evolution *fg_run_evolution(const fg_run *run);

/* Makes the icons of a scale of exactly `count` arrows. density: not distributed; the
 * first scale's arrows start from its clusters unless `even_start`, and each icon's
 * `cluster` is of it; NULL: there is none. finer: the icons of the scale before, whose
 * `parent` is set; NULL: this is the first. ARGUMENT, MEMORY, STOPPED. */
FG_API fg_status fg_run_place(fg_icons **out, fg_context *context,
                              fg_placement *placement, int count,
                              const fg_density *density, bool even_start,
                              fg_icons *finer);

/* The state of a run beside its evolution's, to be stored with a checkpoint. */
typedef struct fg_run_record {
  int wanted[FG_MOST_SCALES], count, next; /* of times `wanted` is not used */
  int taken;                               /* scales */
  int last_clusters;                       /* of the last one */
  int64_t last_step;                       /* likewise */
  fg_step first; /* the first with a number of clusters; step 0: none yet */
} fg_run_record;

/* Fills in the record of a run's present state. */
FG_API void fg_run_describe(fg_run_record *out, const fg_run *run);

/* Puts a run, just created with the same options, into the state of a checkpoint and a
 * record. Collective. As fg_evolution_resume. */
FG_API fg_status fg_run_resume(fg_step *step, fg_run *run,
                               const fg_checkpoint *checkpoint,
                               const fg_run_record *record);

#ifdef __cplusplus
}
#endif

#endif
