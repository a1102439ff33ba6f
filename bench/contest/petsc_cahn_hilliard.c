/* The step of docs/benchmarks.md by PETSc: implicit Euler, Q1 elements, lumped mass, u
 * and w coupled on a DMDA, Newton with whatever Krylov method and preconditioner the
 * options ask for (-pc_type mg -pc_mg_galerkin both ...; bench/contest/run has those in
 * use).
 *
 * One step:   bench_petsc -problem FILE -tau T [-reference FILE] [-output FILE]
 *             [-wanted 1e-3] [-repetitions 3]; the least time counts, so what can be set
 *             up once is free. With a reference: as many Newton steps as bring the error
 *             below `wanted` of the step's change.
 * Whole run:  bench_petsc -problem FILE -until TIME -tau FIRST [-accuracy 0.05]
 *             [-predict 1] [-progress] [-output FILE]
 *
 * In a whole run tau follows the change of u in a step, eta = accuracy, and grows only
 * while Newton is quick. A step is made again with half of it when Newton fails, u
 * changes by more than 3 eta, or the energy rises; after that tau stays below 0.75 of
 * what failed, a limit that each step relaxes by 1.3. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "petsc_system.h"

/* Control of step sizes: the limits of one change, as in src/evolution/stepper.c. */
static const double most_growth = 2.0, most_shrinkage = 0.4, reject_factor = 0.5;
static const double acceptable_increment = 3.0, after_reject = 0.75, relaxation = 1.3;
static const double wanted_newton = 4.0; /* Newton steps that keep tau */

/* The energy of u; `potential` also puts w = Psi'(u) + K u / m beside it. */
static PetscErrorCode evaluate_energy(simulation *s, bool potential, double *energy)
{
  PetscScalar *value;
  const PetscScalar *applied;
  double sum = 0.0, cell = 1.0;
  PetscFunctionBeginUser;
  PetscCall(MatMult(s->linear, s->x, s->work));
  PetscCall(VecGetArray(s->x, &value));
  PetscCall(VecGetArrayRead(s->work, &applied));
  for (size_t n = 0; n < s->nodes; ++n) {
    double u = value[2 * n], well = u * u - 1.0;
    double stiff = applied[2 * n + 1] + s->mass[n] * value[2 * n + 1];
    sum += s->mass[n] * 0.5 * well * well + 0.5 * u * stiff;
    if (potential)
      value[2 * n + 1] = 2.0 * u * well + stiff / s->mass[n];
  }
  PetscCall(VecRestoreArrayRead(s->work, &applied));
  PetscCall(VecRestoreArray(s->x, &value));
  for (int k = 0; k < s->problem.dimension; ++k)
    cell *= s->problem.spacing[k];
  *energy = sum * cell;
  PetscFunctionReturn(0);
}

/* x := the problem's density and its own potential. */
static PetscErrorCode start(simulation *s, double *energy)
{
  PetscScalar *value;
  PetscFunctionBeginUser;
  PetscCall(VecGetArray(s->x, &value));
  for (size_t n = 0; n < s->nodes; ++n) {
    value[2 * n] = (double)s->problem.u[n];
    value[2 * n + 1] = 0.0;
  }
  PetscCall(VecRestoreArray(s->x, &value));
  PetscCall(evaluate_energy(s, true, energy));
  PetscCall(VecCopy(s->x, s->before));
  PetscFunctionReturn(0);
}

static PetscErrorCode take_density(const simulation *s, double *u)
{
  const PetscScalar *value;
  PetscFunctionBeginUser;
  PetscCall(VecGetArrayRead(s->x, &value));
  for (size_t n = 0; n < s->nodes; ++n)
    u[n] = value[2 * n];
  PetscCall(VecRestoreArrayRead(s->x, &value));
  PetscFunctionReturn(0);
}

static PetscErrorCode write_density(const simulation *s)
{
  char path[PETSC_MAX_PATH_LEN];
  PetscBool wanted;
  double *u;
  PetscFunctionBeginUser;
  PetscCall(PetscOptionsGetString(NULL, NULL, "-output", path, sizeof path, &wanted));
  if (!wanted)
    PetscFunctionReturn(0);
  PetscCall(PetscMalloc1(s->nodes, &u));
  PetscCall(take_density(s, u));
  bool written = problem_write_density(&s->problem, path, u);
  PetscCall(PetscFree(u));
  PetscFunctionReturn(written ? 0 : PETSC_ERR_FILE_WRITE);
}

/* Distance of x from the reference, as a share of the step's own change. */
static PetscErrorCode relative_error(const simulation *s, Vec x, double *error)
{
  const PetscScalar *value;
  PetscFunctionBeginUser;
  PetscCall(VecGetArrayRead(x, &value));
  for (size_t n = 0; n < s->nodes; ++n)
    s->plain[n] = value[2 * n];
  PetscCall(VecRestoreArrayRead(x, &value));
  *error = problem_distance(&s->problem, s->plain, s->reference) / s->change;
  PetscFunctionReturn(0);
}

static PetscErrorCode watch(SNES snes, PetscInt iteration, PetscReal norm, void *data)
{
  simulation *s = data;
  Vec x;
  double error;
  PetscFunctionBeginUser;
  (void)norm;
  PetscCall(SNESGetSolution(snes, &x));
  PetscCall(relative_error(s, x, &error));
  if (s->enough < 0 && error <= s->wanted)
    s->enough = iteration;
  PetscFunctionReturn(0);
}

/* Reads the reference, and finds how many Newton steps come near enough to it: no more
 * are made from then on. */
static PetscErrorCode find_enough(simulation *s)
{
  char path[PETSC_MAX_PATH_LEN];
  PetscBool given;
  double energy;
  PetscFunctionBeginUser;
  PetscCall(PetscOptionsGetString(NULL, NULL, "-reference", path, sizeof path, &given));
  if (!given)
    PetscFunctionReturn(0);
  s->reference = problem_read_density(&s->problem, path);
  if (!s->reference)
    PetscFunctionReturn(PETSC_ERR_FILE_READ);
  PetscCall(PetscMalloc1(s->nodes, &s->plain));
  for (size_t n = 0; n < s->nodes; ++n)
    s->plain[n] = (double)s->problem.u[n];
  s->change = problem_distance(&s->problem, s->plain, s->reference);
  s->wanted = 1e-3;
  s->enough = -1;
  PetscCall(PetscOptionsGetReal(NULL, NULL, "-wanted", &s->wanted, NULL));
  PetscCall(SNESMonitorSet(s->snes, watch, s, NULL));
  PetscCall(start(s, &energy));
  PetscCall(SNESSolve(s->snes, NULL, s->x));
  PetscCall(SNESMonitorCancel(s->snes));
  if (s->enough > 0)
    PetscCall(SNESSetTolerances(s->snes, 0.0, 0.0, 0.0, (int)s->enough, -1));
  PetscFunctionReturn(0);
}

static PetscErrorCode one_step(simulation *s, double tau)
{
  PetscInt repetitions = 3, newton, linear;
  SNESConvergedReason reason;
  double least = INFINITY, least_wall = INFINITY, energy, error = NAN;
  PetscFunctionBeginUser;
  PetscCall(PetscOptionsGetInt(NULL, NULL, "-repetitions", &repetitions, NULL));
  PetscCall(system_set_tau(s, tau));
  PetscCall(find_enough(s));
  for (PetscInt n = 0; n < repetitions; ++n) {
    PetscCall(start(s, &energy));
    double processor = processor_seconds(), wall = wall_seconds();
    PetscCall(SNESSolve(s->snes, NULL, s->x));
    least = fmin(least, processor_seconds() - processor);
    least_wall = fmin(least_wall, wall_seconds() - wall);
  }
  PetscCall(SNESGetConvergedReason(s->snes, &reason));
  PetscCall(SNESGetIterationNumber(s->snes, &newton));
  PetscCall(SNESGetLinearSolveIterations(s->snes, &linear));
  if (s->reference)
    PetscCall(relative_error(s, s->x, &error));
  bool reached = s->reference ? error <= s->wanted : reason > 0;
  printf("cpu %.5f wall %.5f error %.2e change %.4f MB %.0f iterations %d Newton, %d "
         "linear%s\n",
         least, least_wall, error, s->change, most_megabytes(), (int)newton, (int)linear,
         reached ? "" : " (not reached)");
  PetscCall(write_density(s));
  PetscFunctionReturn(0);
}

/* Mass-weighted rms of u - u_before. */
static PetscErrorCode increment(const simulation *s, double *out)
{
  const PetscScalar *value, *before;
  double sum = 0.0;
  PetscFunctionBeginUser;
  PetscCall(VecGetArrayRead(s->x, &value));
  PetscCall(VecGetArrayRead(s->before, &before));
  for (size_t n = 0; n < s->nodes; ++n) {
    double change = value[2 * n] - before[2 * n];
    sum += s->mass[n] * change * change;
  }
  PetscCall(VecRestoreArrayRead(s->before, &before));
  PetscCall(VecRestoreArrayRead(s->x, &value));
  *out = sqrt(sum / s->total_mass);
  PetscFunctionReturn(0);
}

static PetscErrorCode whole_run(simulation *s, double tau, double until)
{
  double accuracy = 0.05, energy, time = s->problem.time, last_tau = 0.0,
         limit = INFINITY;
  PetscBool predict = PETSC_TRUE, progress = PETSC_FALSE;
  PetscInt accepted = 0, rejected = 0, newton = 0, linear = 0;
  Vec earlier;
  PetscFunctionBeginUser;
  PetscCall(PetscOptionsGetReal(NULL, NULL, "-accuracy", &accuracy, NULL));
  PetscCall(PetscOptionsGetBool(NULL, NULL, "-predict", &predict, NULL));
  PetscCall(PetscOptionsGetBool(NULL, NULL, "-progress", &progress, NULL));
  PetscCall(VecDuplicate(s->x, &earlier));
  PetscCall(start(s, &energy));
  double processor = processor_seconds(), wall = wall_seconds();
  while (time < until) {
    tau = fmin(tau, limit);
    double step = fmin(tau, until - time), change = 0.0, new_energy = 0.0;
    SNESConvergedReason reason;
    PetscCall(VecCopy(s->x, s->before));
    if (predict && last_tau > 0.0) {
      /* x := x + omega (x - earlier) */
      double omega = fmin(step / last_tau, 2.0);
      PetscCall(VecScale(s->x, 1.0 + omega));
      PetscCall(VecAXPY(s->x, -omega, earlier));
    }
    PetscCall(system_set_tau(s, step));
    PetscCall(SNESSolve(s->snes, NULL, s->x));
    PetscCall(SNESGetConvergedReason(s->snes, &reason));
    PetscInt newton_here, linear_here;
    PetscCall(SNESGetIterationNumber(s->snes, &newton_here));
    PetscCall(SNESGetLinearSolveIterations(s->snes, &linear_here));
    newton += newton_here;
    linear += linear_here;
    PetscCall(increment(s, &change));
    PetscCall(evaluate_energy(s, false, &new_energy));
    if (progress)
      fprintf(stderr, "t %.4e tau %.3e change %.4f E %.6f Newton %d linear %d %s\n", time,
              step, change, new_energy, (int)newton_here, (int)linear_here,
              SNESConvergedReasons[reason]);
    if (reason > 0 && change <= acceptable_increment * accuracy && new_energy <= energy) {
      time += step;
      last_tau = step;
      energy = new_energy;
      ++accepted;
      PetscCall(VecCopy(s->before, earlier));
      double factor = fmin(accuracy / change, sqrt(wanted_newton / (double)newton_here));
      tau = step * fmin(fmax(factor, most_shrinkage), most_growth);
      limit *= relaxation;
    } else {
      PetscCall(VecCopy(s->before, s->x));
      last_tau = 0.0;
      ++rejected;
      limit = after_reject * step;
      tau = reject_factor * step;
      if (!(tau > 1e-12 * until))
        break;
    }
  }
  printf("cpu %.3f wall %.3f MB %.0f t %.6e E %.6f steps %d rejected %d Newton %d linear "
         "%d\n",
         processor_seconds() - processor, wall_seconds() - wall, most_megabytes(), time,
         energy, (int)accepted, (int)rejected, (int)newton, (int)linear);
  PetscCall(write_density(s));
  PetscCall(VecDestroy(&earlier));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  simulation s = {0};
  char path[PETSC_MAX_PATH_LEN] = "";
  double tau = 0.0, until = 0.0;
  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(PetscOptionsGetString(NULL, NULL, "-problem", path, sizeof path, NULL));
  PetscCall(PetscOptionsGetReal(NULL, NULL, "-tau", &tau, NULL));
  PetscCall(PetscOptionsGetReal(NULL, NULL, "-until", &until, NULL));
  if (!problem_read(&s.problem, path) || !(tau > 0.0))
    return 2;
  s.tau = tau;
  PetscCall(system_create(&s));
  if (until > 0.0)
    PetscCall(whole_run(&s, tau, until));
  else
    PetscCall(one_step(&s, tau));
  PetscCall(system_destroy(&s));
  PetscCall(PetscFinalize());
  return 0;
}
