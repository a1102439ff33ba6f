#include "petsc_system.h"

#include <math.h>
#include <stdlib.h>

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
PetscErrorCode system_set_tau(simulation *s, double tau)
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

PetscErrorCode system_create(simulation *s)
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

PetscErrorCode system_destroy(simulation *s)
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
