/* The problem that all contestants of `make bench` solve: mesh, tensor and density in one
 * file, so that none of them has a tensor or a start of its own. */
#ifndef BENCH_PROBLEM_H
#define BENCH_PROBLEM_H

#include <stdbool.h>
#include <stddef.h>

/* Lengths in units of the domain's longest side; natural boundaries, no mask. On file:
 * lines "name value ..." up to a line "data"; then tensor and u as the machine's floats.
 */
typedef struct problem {
  int dimension;
  int cells[3], nodes[3]; /* cells[2] = nodes[2] = 1 in 2D */
  double spacing[3], gamma;
  double time, energy, tau; /* of the density, and the step that led to it */
  int clusters;             /* 0: not counted yet */
  double debris_area;       /* components smaller than this are no clusters */
  float *tensor;            /* per cell, x fastest: xx xy yy, or xx xy xz yy yz zz */
  float *u;                 /* per node, x fastest */
} problem;

static inline int problem_tensor_entries(const problem *p)
{
  return p->dimension == 3 ? 6 : 3;
}
size_t problem_cell_count(const problem *p);
size_t problem_node_count(const problem *p);

/* Lumped mass of a node, in units of a cell: 1 inside, halved at each boundary. */
double problem_node_mass(const problem *p, size_t node);

/* sqrt(sum m (a - b)^2 / sum m) over the nodes, m the lumped mass. */
double problem_distance(const problem *p, const double *a, const double *b);

/* False, with a message on stderr, when a file cannot be read or written. */
bool problem_read(problem *out, const char *path);
bool problem_write(const problem *p, const char *path);
void problem_clear(problem *p);

/* A density as plain doubles, one a node; NULL when there is no such file. The caller
 * frees it. */
double *problem_read_density(const problem *p, const char *path);
bool problem_write_density(const problem *p, const char *path, const double *u);

/* Processor seconds of this process, and its largest memory in MB. */
double processor_seconds(void);
double wall_seconds(void);
double most_megabytes(void);

#endif
