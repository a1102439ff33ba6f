/* The descent: icons are moved, added and removed as long as the energy falls
 * (docs/method/placement.md). */
#ifndef FG__PLACE_SEARCH_H
#define FG__PLACE_SEARCH_H

#include "place/search/worker.h"

typedef struct fg__place_icon {
  fg__place_seed seed;
  fg__place_steps steps; /* of lines from that place */
  fg__place_line line;
  fg__place_contribution contribution; /* of its line to what readers reconstruct */
  double step;                         /* of its moves, input coordinates */
  int move;                            /* the last one that was accepted, */
  bool has_moved;                      /* at the last visit */
  bool waits;                          /* for a visit in the present sweep */
  int identity;          /* stays as the icon moves, and from scale to scale */
  double removal_cost;   /* by how much the energy rises when the icon is removed */
  bool has_removal_cost; /* it is known */
} fg__place_icon;

typedef struct fg__place_search {
  const fg__place_domain *domain;
  fg_context *context;
  fg__place_scale scale;
  fg__place_raster raster;
  fg__place_weights weights;
  fg__place_diffusion diffusion;
  double reference_error; /* E0, degrees */
  fg__place_icon **icon;  /* [count] */
  fg__place_box *box;     /* [count] of each icon's contribution */
  int count;
  size_t capacity, box_capacity;
  int next_identity;
  double least_step;    /* of moves, lambda: below, an icon is no longer moved */
  fg__threads *threads; /* that share its work, borrowed; NULL: the caller alone */
  /* Working memory: */
  fg__place_worker own, *helper; /* the caller's, and [helper_count] of other threads */
  size_t helper_count;
  struct fg__place_visit *visit; /* [visit_count] */
  size_t visit_count;
  float *map, *smooth; /* a value a raster cell */
} fg__place_search;

/* Starts a search for `count` icons, with none yet. MEMORY. */
fg_status fg__place_search_create(fg__place_search *out, fg_context *context,
                                  const fg__place_domain *domain, int count, bool free,
                                  fg__place_grain grain);
void fg__place_search_clear(fg__place_search *search);

/* Changes the number of icons that the search is for. Its icons stay where they are, with
 * lengths in proportion to the new lambda; the penalty of ink stays. MEMORY. */
fg_status fg__place_search_rescale(fg__place_search *search, int count,
                                   fg__place_grain grain);

/* Adds an icon at a seed; *added is false where no line can lie. MEMORY. */
fg_status fg__place_add(fg__place_search *search, bool *added, const fg__place_seed *seed,
                        int identity);
fg_status fg__place_remove(fg__place_search *search, int index);

/* Tries moves of all icons that still move, up to `sweeps` times, large steps first.
 * MEMORY, STOPPED. */
fg_status fg__place_relax(fg__place_search *search, int sweeps);

/* The same after changes in few places: the diffusion reader's field is solved again
 * near them only. MEMORY, STOPPED. */
fg_status fg__place_relax_some(fg__place_search *search, int sweeps);

/* Lets the icons near a place, or all, try moves of at least `step` lambda again. */
void fg__place_reactivate(fg__place_search *search, const double place[3], double step);
void fg__place_reactivate_all(fg__place_search *search, double step);

/* Removes icons, first those whose removal raises the energy least, until `count` are
 * left. Then their neighbours may move, and icons that had not stopped moving. MEMORY,
 * STOPPED. */
fg_status fg__place_thin(fg__place_search *search, int count);

/* Inserts or removes icons until there are as many as the search is for. Where no more
 * fit, shorter lines are allowed; where that does not help, there are fewer. MEMORY,
 * STOPPED. */
fg_status fg__place_complete(fg__place_search *search);

/* Exchanges an icon for one elsewhere, at most `most` times, and stops after `failures`
 * exchanges that did not lower the energy by more than a share of it. MEMORY, STOPPED. */
fg_status fg__place_exchange(fg__place_search *search, int most, int failures,
                             double least_fall);

/* The icons' seeds and the penalty of ink, to be restored. */
typedef struct fg__place_snapshot {
  struct fg__place_remembered {
    fg__place_seed seed;
    double step, removal_cost;
    int identity;
    bool has_removal_cost;
  } * icon; /* [count] */
  int count;
  double ink, shortest;
} fg__place_snapshot;

/* Stores the state in `out`, whose earlier content is lost. MEMORY. */
fg_status fg__place_remember(fg__place_snapshot *out, fg__place_search *search);
fg_status fg__place_restore(fg__place_search *search, const fg__place_snapshot *from);
void fg__place_snapshot_clear(fg__place_snapshot *snapshot);

/* The readers' mean error now, degrees. MEMORY. */
fg_status fg__place_error(fg__place_search *search, double *error);

/* The share of the lines that touches another one. MEMORY. */
fg_status fg__place_touching(fg__place_search *search, double *share);

/* Sets E0 to that error. MEMORY. */
fg_status fg__place_set_reference_error(fg__place_search *search);

/* The energy of all. MEMORY. */
fg_status fg__place_energy(fg__place_search *search, double *energy);

/* Sum of lengths in count * lambda. */
double fg__place_ink(const fg__place_search *search);

/* For the search's own files: */

/* R in lambda. */
static inline double fg__place_reach(const fg__place_search *search)
{
  return search->scale.reach / search->scale.lambda;
}

/* The penalties of a line: those of its length, and those for lines near it, given by
 * their samples. */
double fg__place_line_penalty(const fg__place_scale *scale, const fg__place_points *near,
                              const fg__place_line *line);

void fg__place_visits_clear(fg__place_search *search);

/* Marks the removal costs of icons that contribute to a box as unknown, before or after a
 * change there. */
void fg__place_forget_removal_costs(fg__place_search *search, const fg__place_box *box);

/* Sets search->own.others to the contribution of all icons to all cells. MEMORY. */
fg_status fg__place_gather_whole(fg__place_search *search);

/* A seed for a new icon, and how much that would lower the energy. */
typedef struct fg__place_candidate {
  fg__place_seed seed;
  double fall;
} fg__place_candidate;

enum { FG__PLACE_CANDIDATES = 30 };

typedef struct fg__place_candidates {
  fg__place_candidate *list; /* [most], of which `count` are there */
  int most, count;
} fg__place_candidates;

/* The best candidates where readers err most, in descending order. MEMORY. */
fg_status fg__place_list_candidates(fg__place_candidates *best, fg__place_search *search);

#endif
