/* The evolution of a density u whose positive components become ever fewer, larger
 * clusters. */
#ifndef FLOWGRAIN_EVOLUTION_H
#define FLOWGRAIN_EVOLUTION_H

#include "flowgrain/field.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct fg_evolution fg_evolution;

typedef enum fg_energy {
  FG_ENERGY_FLOW = 0,  /* interfaces along streamlines are cheap */
  FG_ENERGY_ISOTROPIC, /* the original Cahn-Hilliard model */
  FG_ENERGY_GRADIENT,  /* interfaces along level sets of the speed are cheap */
  FG_ENERGY_LAW        /* the caller's own: `law` in the options */
} fg_energy;

typedef struct fg_energy_law fg_energy_law; /* flowgrain/energy.h */

/* Time schemes of the same equation; docs/method/schemes.md compares them. */
typedef enum fg_scheme {
  FG_SCHEME_BDF2 = 0, /* backward differences of second order: steps as large as the
                         change of u allows */
  FG_SCHEME_EULER,    /* implicit Euler: the same of first order */
  FG_SCHEME_THETA     /* theta-splitting in three substeps: second order, small steps */
} fg_scheme;

/* Whether the mesh is coarsened as clusters grow: fg_evolution_should_coarsen. */
typedef enum fg_mesh_kind {
  FG_MESH_AUTO = 0, /* adaptive unless gamma is given */
  FG_MESH_ADAPTIVE,
  FG_MESH_UNIFORM /* stays as it is */
} fg_mesh_kind;

/* Vector instructions of the inner loops; u has the same bits with all. */
typedef enum fg_vectors {
  FG_VECTORS_WIDEST = 0, /* that the machine has */
  FG_VECTORS_GENERIC,    /* what every machine of this architecture has */
  FG_VECTORS_AVX2,       /* at most AVX2 */
  FG_VECTORS_AVX512      /* at most AVX-512 */
} fg_vectors;

/* A zero field means its default, in brackets. */
typedef struct fg_evolution_options {
  int nodes;                /* nodes along the longest side of the mesh [257] */
  fg_mesh_kind mesh;        /* [auto] */
  fg_energy energy;         /* [flow] */
  const fg_energy_law *law; /* NULL: none; else in place of `energy` */
  double anisotropy;        /* a, in (0, 1] [0.15] */
  double isotropic_below;   /* speed, in the input's units, below which a tends to 1 as
                               the speed to 0: a(|v|) = 1 - (1 - a) |v| / this; only
                               with the energy flow [0: a everywhere] */
  double coverage;          /* share of the area clusters shall cover, in (0, 1) [0.3] */
  double gamma;             /* interface energy, in units of the longest side squared
                               [(1.1 h)^2 / a; isotropic (1.5 h)^2] */
  uint64_t seed;            /* of the initial noise [1] */
  double noise;             /* its amplitude, in (0, 5]: u begins with the mean and the
                               standard deviation of uniform values between the mean
                               less this and the mean plus this [1.5] */
  double accuracy;          /* eta: rms change of u allowed in a step [0.08; else 0.05] */
  int cycles;               /* multigrid cycles a step, or a substep [2; else 3] */
  double residual;          /* a step, or a substep, takes `cycles` and then more, until
                               the largest residual of its equation is at most this share
                               of the first guess's; one that 100 cycles do not bring
                               there is rejected. A large one only measures what `cycles`
                               leave [0: not measured] */
  fg_scheme scheme;         /* of the time steps [BDF2] */
  double theta;             /* of the theta scheme, in (0, 1/2): the share of a step that
                               its first and its last substep take; the scheme is of
                               second order with the default alone [1 - 1 / sqrt 2] */
  double alpha;             /* of the theta scheme, in (1/2, 1]: the share of the gradient
                               term that those substeps take implicitly [2 - sqrt 2] */
  int threads;              /* [all cores] */
  fg_vectors vectors;       /* the widest to use [widest] */
  const float *initial; /* u at the nodes of the mesh, x fastest, as in fg_density_arrays;
                           copied, with its own mean; NULL: noise */
} fg_evolution_options;

typedef struct fg_step {
  int64_t step;           /* accepted steps so far */
  double time;            /* t, in units of (longest side)^2 */
  double tau;             /* size of this step */
  double energy;          /* E(u), in units of the longest side; like t and tau it refers
                             to the first mesh (fg_evolution_coarsen) */
  double chemical_energy; /* its part Psi(u), of the double well */
  double gradient_energy; /* its part gamma / 2 grad u . A grad u, of interfaces */
  double mass;            /* integral of u over the domain, in units of (longest side)^2,
                             in 3D ^3 */
  double area_fraction;   /* share of the domain where u > 0 */
  int clusters;           /* components of {u > 0} above the size of debris; 0 while the
                             covered area is below 0.8 of the coverage */
  int cycles;             /* multigrid cycles spent on this step, rejects included */
  int rejected;           /* attempts rejected before this step was accepted */
  double residual;        /* of this step's equation over that of its first guess, of the
                             worst substep; larger than the option's where floats hold no
                             better u; 0 without the option */
  int64_t cells;          /* active cells of the mesh */
  int coarsenings;        /* of the mesh, since the evolution began */
  double increment;       /* rms of the change of u in this step */
  double seconds;         /* wall time since the evolution was created */
  bool stationary;        /* the pattern no longer changes */
} fg_step;

/* Builds mesh, tensor and initial density. nodes is rounded up so that the mesh can be
 * coarsened; fg_evolution_mesh has the result. The field, and what a law's `data`
 * points to, must outlive the evolution. Collective. ARGUMENT (options out of range,
 * ranks that disagree on field or options, more ranks than the mesh has blocks for),
 * MEMORY, MPI. */
FG_API fg_status fg_evolution_create(fg_evolution **out, fg_context *context,
                                     const fg_field *field,
                                     const fg_evolution_options *options);
FG_API void fg_evolution_destroy(fg_evolution *evolution);

/* Makes one accepted time step and describes it. An adaptive mesh is first coarsened
 * where fg_evolution_should_coarsen says so. Collective. NO_CONVERGENCE
 * (no step small enough is accepted; the mean of u has drifted), STOPPED (before the
 * step), MEMORY, MPI. */
FG_API fg_status fg_evolution_step(fg_evolution *evolution, fg_step *step);

/* Whether a mesh with half the cells along each side resolves the clusters: the domain
 * has at least 4096 cells (in 3D 32768) to a cluster, and the longest side at least twice
 * as many as a mesh has by default. False before clusters are counted, and where cells
 * can not be halved along each side. */
FG_API bool fg_evolution_should_coarsen(const fg_evolution *evolution);

/* Coarsens the mesh: half the cells along each side, interfaces twice as wide, four times
 * gamma. u is restricted to every other node and smoothed to the new interface width; its
 * integral is conserved, with missing values its mean. Wider interfaces cost more and
 * move faster: energies are divided, times and time steps multiplied by two, so that they
 * go on as on the first mesh. At most 20 steps make the energy no larger than it was;
 * they are not counted. `step` becomes the present state; it counts no cycles.
 * fg_evolution_step does it by itself. Ranks for which the coarser mesh has no block are
 * idle from then on. Collective. ARGUMENT (the cells can not be coarsened): nothing has
 * changed; NO_CONVERGENCE, MEMORY, MPI: the evolution can only be destroyed. */
FG_API fg_status fg_evolution_coarsen(fg_evolution *evolution, fg_step *step);

/* A coarsening of the mesh: the step after which it was made and that step's time, the
 * energy before and after it, and clusters and cells on the new mesh. */
typedef struct fg_coarsening {
  int64_t step;
  double time, energy_before, energy_after;
  int clusters, cells[3];
} fg_coarsening;

/* The last one since the evolution was created or resumed; NULL: there was none. */
FG_API const fg_coarsening *fg_evolution_coarsening(const fg_evolution *evolution);

typedef struct fg_mesh_info {
  int dimension;
  int cells[3];      /* along each axis */
  double spacing[3]; /* in the input's coordinates */
  double gamma;      /* as used, in units of the longest side squared */
  double anisotropy, isotropic_below, coverage, noise; /* as used */
  double theta, alpha;   /* as used; 0 but with the theta scheme */
  double length;         /* the longest side in the input's coordinates */
  double domain_measure; /* area (volume) of the active cells, units of length squared */
  int64_t active_cells;
  bool adaptive;      /* it is coarsened as clusters grow */
  const char *kernel; /* vector instructions that run: "avx512", "avx2", "generic" */
} fg_mesh_info;

/* The present mesh and the parameters in use, borrowed; a coarsening changes them. */
FG_API const fg_mesh_info *fg_evolution_mesh(const fg_evolution *evolution);

/* Phases of an evolution, by which communication is counted. */
typedef enum fg_phase {
  FG_PHASE_OTHER = 0, /* agreements on statuses, and all outside of the other phases */
  FG_PHASE_SETUP,     /* fg_evolution_create */
  FG_PHASE_STEPS,     /* fg_evolution_step, apart from its cycles and the counting */
  FG_PHASE_CYCLES,    /* multigrid cycles */
  FG_PHASE_COUNTING,  /* clusters and the area covered, at every step */
  FG_PHASE_SNAPSHOTS /* fg_density_create, and icons and files of distributed densities */
} fg_phase;

enum { FG_PHASES = FG_PHASE_SNAPSHOTS + 1 };

/* Communication counters of a rank in one phase. */
typedef struct fg_communication {
  double times;               /* that the phase was begun; 0 for OTHER */
  double exchanges;           /* rounds of messages to the neighbours */
  double messages, bytes;     /* sent to single ranks */
  double gathers, gathered;   /* all-gathers; bytes received from others in them */
  double reductions, reduced; /* all-reductions; bytes that this rank contributes */
} fg_communication;

/* Communication among the ranks of an evolution since its context was given a
 * communicator, by fg_phase: of each counter the mean over ranks and the greatest. All
 * are 0 with one rank. Collective. */
FG_API void fg_evolution_communication(const fg_evolution *evolution,
                                       fg_communication mean[FG_PHASES],
                                       fg_communication greatest[FG_PHASES]);

#ifdef __cplusplus
}
#endif

#endif
