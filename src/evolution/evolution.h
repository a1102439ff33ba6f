/* The state of an evolution, for the files of this folder. */
#ifndef FG__EVOLUTION_H
#define FG__EVOLUTION_H

#include "component/clusters.h"
#include "evolution/coarsened.h"
#include "evolution/stepper.h"

struct fg_evolution {
  fg_context *context;
  fg_evolution_options options; /* with the defaults filled in */
  fg_mesh_info info;
  const fg__ranks *ranks; /* that share it */
  fg__mesh mesh;
  fg__threads *threads;          /* NULL: one thread */
  fg__cells_of_box finest_cells; /* round the block, until stencils are made */
  fg__stepper stepper;
  struct {
    unsigned char *memory;
    const unsigned char *active; /* the block's first cell; NULL: all are active */
    ptrdiff_t row, plane;
  } mask;                       /* of the block's cells, and of one more on each side */
  fg__clusters *clusters_found; /* working memory, for snapshots too */
  size_t nodes, cells;          /* of the whole mesh */
  int64_t active_cells;
  double debris_area; /* in cells */
  double area_fraction;
  int clusters;
  bool counting;         /* clusters are counted: nucleation is over */
  int mesh_nodes;        /* wanted along the longest side of the present mesh */
  int coarsenings;       /* of the mesh, since it was created */
  int64_t earlier_steps; /* accepted on finer meshes */
  const fg__coarsened
      *coarsened; /* NULL, or what a coarser mesh goes on from; while it is made */
  double coarsened_mean;
  double start;           /* on the clock (clock.h) */
  double earlier_seconds; /* spent before a resumed evolution was created */
  /* Of the field, and of the initial density when one was given (else 0). */
  uint64_t field_fingerprint, initial_fingerprint;
  uint64_t law_identity; /* see fg_energy_law */
  const fg_field *field;
  fg_energy_law law;        /* options.law points here */
  fg_coarsening coarsening; /* the last */
  bool has_coarsening;
};

/* The public calls, for given ranks instead of the context's. */
fg_status fg__evolution_create(fg_evolution **out, fg_context *context,
                               const fg__ranks *ranks, const fg_field *field,
                               const fg_evolution_options *options);
fg_status fg__checkpoint_open(fg_checkpoint **out, fg_context *context, const char *path,
                              const fg__ranks *ranks);

/* Of the present mesh, in units of the longest side: the greatest and the least spacing,
 * the volume of a cell, gamma (that of the options or the default), and the growth rate
 * of the fastest mode of linear theory. The theta scheme's splitting. */
double fg__evolution_spacing(const fg_evolution *evolution);
double fg__evolution_least_spacing(const fg_evolution *evolution);
double fg__evolution_cell_volume(const fg_evolution *evolution);
double fg__evolution_interface_energy(const fg_evolution *evolution);
double fg__evolution_growth_rate(const fg_evolution *evolution);
fg__splitting fg__evolution_splitting(const fg_evolution *evolution);

/* The factor 2^coarsenings: times of the present mesh times this, and its energies over
 * this, are those of the first mesh, which are reported. Each coarsening doubles the
 * width of interfaces, and with it their energy and the speed at which clusters coarsen.
 */
double fg__evolution_unit(const fg_evolution *evolution);

/* Makes everything that depends on the mesh, for options that are settled. Collective. */
fg_status fg__evolution_build(fg_evolution *evolution);

/* Half the cells along each side, without what makes the energy fall: for a checkpoint's
 * density. Collective. Statuses as fg_evolution_coarsen. */
fg_status fg__evolution_coarsen_mesh(fg_evolution *evolution);

/* Whether fg_evolution_step coarsens the mesh. */
bool fg__evolution_adapts(const fg_evolution *evolution);

/* Frees what depends on the mesh; the options and the record of the past stay. */
void fg__evolution_clear(fg_evolution *evolution);

/* Sets the finest u to noise, the caller's density or that of a finer mesh. Collective.
 * MEMORY, ARGUMENT (the caller's is not the same on all ranks). */
fg_status fg__evolution_fill(fg_evolution *evolution, const fg__multigrid *multigrid);

/* Finds the share covered and, once nucleation is over, the number of clusters.
 * Collective. MEMORY. */
fg_status fg__evolution_count(fg_evolution *evolution);

double fg__evolution_seconds(const fg_evolution *evolution);

/* The state as a step; it took these cycles and rejected attempts. */
fg_step fg__evolution_describe(const fg_evolution *evolution, int cycles, int rejected);

#endif
