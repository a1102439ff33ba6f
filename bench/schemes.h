/* Steps of backward differences, of first order (implicit Euler) and of second, and of
 * the theta scheme compared, for docs/method/schemes.md:
 * vortex3, 257 nodes, from the densities of one tight run at 150, 40 and 12 clusters. */
#ifndef BENCH_SCHEMES_H
#define BENCH_SCHEMES_H

#include "evolution/stepper.h"

typedef enum scheme { EULER, BDF2, THETA, SCHEMES } scheme;
extern const char *const scheme_names[SCHEMES];

enum { NODES = 257, COUNT = NODES * NODES, SNAPSHOTS = 3 };

/* Ends the program, with a message, when something is not good. */
void check(bool good, const char *what);

typedef struct snapshot {
  const char *name;
  double time;
  int clusters;
  float *u; /* COUNT values, x fastest */
} snapshot;

/* Of one run by BDF2 with eta = 0.01 and six cycles a step. */
void take_snapshots(snapshot snapshots[SNAPSHOTS], fg_field *field);

/* The equation, as fg_evolution_create sets it up; lengths in units of the side. */
typedef struct domain {
  fg__mesh mesh;
  fg__tensor tensor;
  double h, gamma, volume; /* volume: of a cell */
} domain;

void domain_create(domain *out, fg_field *field);
void domain_clear(domain *d);

/* With the default theta. */
static inline fg__splitting splitting_of(double alpha)
{
  return (fg__splitting){fg__theta_default.theta, alpha};
}

/* alpha 0: for implicit steps. */
void create_multigrid(fg__multigrid *out, const domain *d, double alpha);

/* The theta scheme's longest by linear theory, for any alpha. */
double stable_step(const domain *d, double alpha);

/* The program's own stepper, for steps of one length. */
void create_stepper(fg__stepper *out, const domain *d, const float *u, scheme by,
                    int cycles, double most_tau);

/* Steps of at most tau for a time; what is rejected is taken in shorter ones. */
void advance(fg__stepper *s, double time, double tau);
void export_current(const fg__stepper *s, float *u);

/* What is taken as exact: the theta scheme in a tenth of its stable step. */
void create_exact(fg__stepper *out, const domain *d, const float *u);
double exact_step(const domain *d);

float *plain_array(void);

/* Shares of the rms of u about its mean, and of the rms of the change since start. */
typedef struct error {
  double of_u, of_change;
} error;
error error_of(const float *u, const float *exact, const float *start);

/* Prints how long steps can be. */
void compare_lengths(const domain *d, const snapshot snapshots[SNAPSHOTS]);

#endif
