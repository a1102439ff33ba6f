/* The system of one implicit Euler step, assembled for PETSc. */
#ifndef BENCH_PETSC_SYSTEM_H
#define BENCH_PETSC_SYSTEM_H

#include <petscdmda.h>
#include <petscsnes.h>
#include <stdbool.h>

#include "problem.h"

typedef struct simulation {
  problem problem;
  size_t nodes;
  double *mass, total_mass; /* relative: 1 inside */
  double tau;
  Mat linear, jacobian;   /* (m u + tau L w, K u - m w); the same with Psi'' */
  PetscInt *curvature_at; /* of each node, in the values of the Jacobian */
  Vec before, x, work;
  double *reference, *plain, change, wanted; /* one step: see find_enough */
  PetscInt enough;
  SNES snes;
} simulation;

/* Assembles the matrices and prepares Newton; problem and tau are given. */
PetscErrorCode system_create(simulation *s);
PetscErrorCode system_destroy(simulation *s);

PetscErrorCode system_set_tau(simulation *s, double tau);

#endif
