/* The step of docs/benchmarks.md by PETSc: implicit Euler, Q1 elements, lumped mass, u
 * and w coupled on a DMDA, Newton with whatever Krylov method and preconditioner the
 * options ask for (-pc_type mg -pc_mg_galerkin both ...; bench/rivals has those in use).
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
#include <petscdmda.h>
#include <petscsnes.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

#include "problem.h"

/* Control of step sizes: the limits of one change, as in src/evolution/stepper.c. */
static const double most_growth = 2.0, most_shrinkage = 0.4, reject_factor = 0.5;
static const double acceptable_increment = 3.0, after_reject = 0.75, relaxation = 1.3;
static const double wanted_newton = 4.0; /* Newton steps that keep tau */

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

/* integral over a cell of d_k phi_a d_l phi_b, divided by the cell's measure; two Gauss
 * points an axis are exact. Corner a has bit k set when it is the upper one along k. */
static double gradient_product(const problem *p, int a, int b, int k, int l)
{
  double sum = 0.0;
  int corners = 1 << p->dimension;
  for (int q = 0; q < corners; ++q) {
    double first = 1.0, second = 1.0;
    for (int d = 0; d < p->dimension; ++d) {
      double place = 0.5 + ((q >> d & 1) != 0 ? 0.5 : -0.5) / sqrt(3.0);
      bool a_upper = a >> d & 1, b_upper = b >> d & 1;
      double a_slope = (a_upper ? 1.0 : -1.0) / p->spacing[d];
      double b_slope = (b_upper ? 1.0 : -1.0) / p->spacing[d];
      first *= d == k ? a_slope : a_upper ? place : 1.0 - place;
      second *= d == l ? b_slope : b_upper ? place : 1.0 - place;
    }
    sum += first * second / corners;
  }
  return sum;
}

enum { MOST_CORNERS = 8, MOST_ROWS = 2 * MOST_CORNERS };

static double products[3][3][MOST_CORNERS][MOST_CORNERS];

static void fill_products(const problem *p)
{
  int corners = 1 << p->dimension;
  for (int k = 0; k < p->dimension; ++k)
    for (int l = 0; l < p->dimension; ++l)
      for (int a = 0; a < corners; ++a)
        for (int b = 0; b < corners; ++b)
          products[k][l][a][b] = gradient_product(p, a, b, k, l);
}

static PetscInt corner_node(const problem *p, const int cell[3], int corner)
{
  int x = cell[0] + (corner & 1), y = cell[1] + (corner >> 1 & 1);
  int z = cell[2] + (corner >> 2 & 1);
  return (z * p->nodes[1] + y) * p->nodes[0] + x;
}

/* Adds gamma A : grad grad and the Laplacian of one cell. */
static void add_cell_matrices(const problem *p, size_t cell, double *energy,
                              double *laplacian)
{
  int corners = 1 << p->dimension, entry = 0;
  const float *tensor = p->tensor + cell * (size_t)problem_tensor_entries(p);
  for (int k = 0; k < p->dimension; ++k)
    for (int l = k; l < p->dimension; ++l, ++entry)
      for (int a = 0; a < corners; ++a)
        for (int b = 0; b < corners; ++b) {
          double product = products[k][l][a][b];
          if (k == l)
            laplacian[a * corners + b] += product;
          else
            product += products[l][k][a][b];
          energy[a * corners + b] += p->gamma * (double)tensor[entry] * product;
        }
}

static PetscErrorCode add_cell(simulation *s, const int cell[3], size_t index)
{
  const problem *p = &s->problem;
  int corners = 1 << p->dimension, size = 2 * corners;
  double energy[MOST_CORNERS * MOST_CORNERS] = {0};
  double laplacian[MOST_CORNERS * MOST_CORNERS] = {0};
  PetscScalar block[MOST_ROWS * MOST_ROWS] = {0};
  PetscInt rows[MOST_ROWS];
  PetscFunctionBeginUser;
  add_cell_matrices(p, index, energy, laplacian);
  for (int a = 0; a < corners; ++a) {
    rows[2 * a] = 2 * corner_node(p, cell, a);
    rows[2 * a + 1] = rows[2 * a] + 1;
    block[2 * a * size + 2 * a] = 1.0 / corners;
    block[(2 * a + 1) * size + 2 * a + 1] = -1.0 / corners;
    for (int b = 0; b < corners; ++b) {
      block[2 * a * size + 2 * b + 1] = s->tau * laplacian[a * corners + b];
      block[(2 * a + 1) * size + 2 * b] = energy[a * corners + b];
    }
  }
  PetscCall(MatSetValues(s->linear, size, rows, size, rows, block, ADD_VALUES));
  PetscFunctionReturn(0);
}

static PetscErrorCode assemble(simulation *s)
{
  const problem *p = &s->problem;
  size_t index = 0;
  PetscFunctionBeginUser;
  fill_products(p);
  for (int k = 0; k < p->cells[2]; ++k)
    for (int j = 0; j < p->cells[1]; ++j)
      for (int i = 0; i < p->cells[0]; ++i)
        PetscCall(add_cell(s, (const int[3]){i, j, k}, index++));
  PetscCall(MatAssemblyBegin(s->linear, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(s->linear, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

/* Where d(second equation of node n)/du_n lies among the stored values. */
static PetscErrorCode locate_curvature(simulation *s)
{
  const PetscInt *row_start, *column;
  PetscInt rows;
  PetscBool done;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(s->nodes, &s->curvature_at));
  PetscCall(MatGetRowIJ(s->jacobian, 0, PETSC_FALSE, PETSC_FALSE, &rows, &row_start,
                        &column, &done));
  for (PetscInt n = 0; n < rows / 2; ++n)
    for (PetscInt k = row_start[2 * n + 1]; k < row_start[2 * n + 2]; ++k)
      if (column[k] == 2 * n)
        s->curvature_at[n] = k;
  PetscCall(MatRestoreRowIJ(s->jacobian, 0, PETSC_FALSE, PETSC_FALSE, &rows, &row_start,
                            &column, &done));
  PetscFunctionReturn(0);
}

/* Only the first equation's couplings to w hold tau. */
static PetscErrorCode set_tau(simulation *s, double tau)
{
  const PetscInt *row_start, *column;
  PetscInt rows;
  PetscScalar *entry;
  PetscBool done;
  PetscFunctionBeginUser;
  PetscCall(MatGetRowIJ(s->linear, 0, PETSC_FALSE, PETSC_FALSE, &rows, &row_start,
                        &column, &done));
  PetscCall(MatSeqAIJGetArray(s->linear, &entry));
  for (PetscInt row = 0; row < rows; row += 2)
    for (PetscInt k = row_start[row]; k < row_start[row + 1]; ++k)
      if (column[k] % 2 == 1)
        entry[k] *= tau / s->tau;
  PetscCall(MatSeqAIJRestoreArray(s->linear, &entry));
  PetscCall(MatRestoreRowIJ(s->linear, 0, PETSC_FALSE, PETSC_FALSE, &rows, &row_start,
                            &column, &done));
  s->tau = tau;
  PetscFunctionReturn(0);
}

/* f = (m (u - u_before) + tau L w, m Psi'(u) + K u - m w), Psi'(u) = 2 u (u^2 - 1) */
static PetscErrorCode evaluate_residual(SNES snes, Vec x, Vec f, void *data)
{
  simulation *s = data;
  const PetscScalar *value, *before;
  PetscScalar *residual;
  PetscFunctionBeginUser;
  (void)snes;
  PetscCall(MatMult(s->linear, x, f));
  PetscCall(VecGetArrayRead(x, &value));
  PetscCall(VecGetArrayRead(s->before, &before));
  PetscCall(VecGetArray(f, &residual));
  for (size_t n = 0; n < s->nodes; ++n) {
    double u = value[2 * n];
    residual[2 * n] -= s->mass[n] * before[2 * n];
    residual[2 * n + 1] += s->mass[n] * 2.0 * u * (u * u - 1.0);
  }
  PetscCall(VecRestoreArray(f, &residual));
  PetscCall(VecRestoreArrayRead(s->before, &before));
  PetscCall(VecRestoreArrayRead(x, &value));
  PetscFunctionReturn(0);
}

static PetscErrorCode evaluate_jacobian(SNES snes, Vec x, Mat jacobian,
                                        Mat preconditioner, void *data)
{
  simulation *s = data;
  const PetscScalar *value;
  PetscScalar *entry;
  PetscFunctionBeginUser;
  (void)snes;
  (void)preconditioner;
  PetscCall(MatCopy(s->linear, jacobian, SAME_NONZERO_PATTERN));
  PetscCall(VecGetArrayRead(x, &value));
  PetscCall(MatSeqAIJGetArray(jacobian, &entry));
  for (size_t n = 0; n < s->nodes; ++n)
    entry[s->curvature_at[n]] += s->mass[n] * (6.0 * value[2 * n] * value[2 * n] - 2.0);
  PetscCall(MatSeqAIJRestoreArray(jacobian, &entry));
  PetscCall(VecRestoreArrayRead(x, &value));
  PetscFunctionReturn(0);
}

static PetscErrorCode create_grid(const problem *p, DM *grid)
{
  const DMBoundaryType none = DM_BOUNDARY_NONE;
  const int *n = p->nodes;
  PetscFunctionBeginUser;
  if (p->dimension == 2)
    PetscCall(DMDACreate2d(PETSC_COMM_SELF, none, none, DMDA_STENCIL_BOX, n[0], n[1], 1,
                           1, 2, 1, NULL, NULL, grid));
  else
    PetscCall(DMDACreate3d(PETSC_COMM_SELF, none, none, none, DMDA_STENCIL_BOX, n[0],
                           n[1], n[2], 1, 1, 1, 2, 1, NULL, NULL, NULL, grid));
  PetscCall(DMSetMatType(*grid, MATAIJ));
  PetscCall(DMSetFromOptions(*grid));
  PetscCall(DMSetUp(*grid));
  PetscCall(DMDASetFieldName(*grid, 0, "u"));
  PetscCall(DMDASetFieldName(*grid, 1, "w"));
  PetscFunctionReturn(0);
}

static PetscErrorCode create(simulation *s)
{
  DM grid;
  PetscFunctionBeginUser;
  s->nodes = problem_node_count(&s->problem);
  PetscCall(PetscMalloc1(s->nodes, &s->mass));
  for (size_t n = 0; n < s->nodes; ++n) {
    s->mass[n] = problem_node_mass(&s->problem, n);
    s->total_mass += s->mass[n];
  }
  PetscCall(create_grid(&s->problem, &grid));
  PetscCall(DMCreateMatrix(grid, &s->linear));
  PetscCall(DMCreateMatrix(grid, &s->jacobian));
  PetscCall(DMCreateGlobalVector(grid, &s->x));
  PetscCall(VecDuplicate(s->x, &s->before));
  PetscCall(VecDuplicate(s->x, &s->work));
  PetscCall(assemble(s));
  PetscCall(locate_curvature(s));
  PetscCall(SNESCreate(PETSC_COMM_SELF, &s->snes));
  PetscCall(SNESSetDM(s->snes, grid));
  PetscCall(SNESSetFunction(s->snes, NULL, evaluate_residual, s));
  PetscCall(SNESSetJacobian(s->snes, s->jacobian, s->jacobian, evaluate_jacobian, s));
  PetscCall(SNESSetFromOptions(s->snes));
  PetscCall(DMDestroy(&grid));
  PetscFunctionReturn(0);
}

static PetscErrorCode destroy(simulation *s)
{
  PetscFunctionBeginUser;
  PetscCall(SNESDestroy(&s->snes));
  PetscCall(VecDestroy(&s->x));
  PetscCall(VecDestroy(&s->before));
  PetscCall(VecDestroy(&s->work));
  PetscCall(MatDestroy(&s->jacobian));
  PetscCall(MatDestroy(&s->linear));
  PetscCall(PetscFree(s->curvature_at));
  PetscCall(PetscFree(s->mass));
  PetscCall(PetscFree(s->plain));
  free(s->reference);
  problem_clear(&s->problem);
  PetscFunctionReturn(0);
}

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
  PetscCall(set_tau(s, tau));
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
    PetscCall(set_tau(s, step));
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
  PetscCall(create(&s));
  if (until > 0.0)
    PetscCall(whole_run(&s, tau, until));
  else
    PetscCall(one_step(&s, tau));
  PetscCall(destroy(&s));
  PetscCall(PetscFinalize());
  return 0;
}
