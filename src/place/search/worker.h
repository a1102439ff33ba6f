/* Trials of lines by several threads. They leave the search as it is, so that any number
 * of threads finds the same. */
#ifndef FG__PLACE_WORKER_H
#define FG__PLACE_WORKER_H

#include "base/threads.h"
#include "place/reader/diffusion.h"

struct fg__place_search;

/* A thread's memory. Its functions do not record a message of their MEMORY. */
typedef struct fg__place_worker {
  const struct fg__place_search *search;
  fg__place_contribution others; /* of the icons that were gathered last, */
  fg__place_points beside;       /* their samples, */
  int *near;                     /* [near_count] and which they are */
  int near_count;
  size_t near_capacity;
  fg__place_contribution trial; /* of a line */
  fg__place_window window;      /* where the diffusion reader's field is solved for it */
} fg__place_worker;

void fg__place_worker_clear(fg__place_worker *worker);

/* Sets worker->others to the sum of the contributions to a box of all icons but `except`
 * (-1: none). MEMORY. */
fg_status fg__place_gather(fg__place_worker *worker, const fg__place_box *box,
                           int except);

/* Finds the icons that contribute to a box, without their contributions. MEMORY. */
fg_status fg__place_find_near(fg__place_worker *worker, const fg__place_box *box,
                              int except);

/* What line `to` in place of line `from` (NULL: none) adds to the weighted errors of the
 * diffusion reader. MEMORY. */
fg_status fg__place_diffusion_cost(double *cost, fg__place_worker *worker,
                                   const fg__place_line *from, const fg__place_line *to);

/* Records a worker's MEMORY; returns the status. */
fg_status fg__place_check(const struct fg__place_search *search, fg_status status);

/* Does thing n of several. */
typedef fg_status fg__place_task(void *argument, fg__place_worker *worker, int n);

/* Does `count` things that do not depend on each other, by all threads of the search.
 * MEMORY. */
fg_status fg__place_share(struct fg__place_search *search, fg__place_task *task,
                          void *argument, int count);

#endif
