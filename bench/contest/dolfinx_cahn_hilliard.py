"""The step of docs/benchmarks.md by DOLFINx: mixed Q1 elements, mass lumped by quadrature
at the vertices, implicit Euler, Newton.

usage: dolfinx_cahn_hilliard.py PROBLEM step TAU REFERENCE ERROR REPETITIONS [PETSC OPTION ...]
       dolfinx_cahn_hilliard.py PROBLEM run FIRST_TAU UNTIL OUTPUT [PETSC OPTION ...]

step: Newton goes on until u is nearer than ERROR, a share of the step's own change, to the
reference; the least of the repetitions counts. run: tau follows the change of u, as in
petsc_cahn_hilliard.c. PETSc options choose the linear solver.
"""

import resource
import sys
import time

import numpy as np
import ufl
from dolfinx import fem, mesh
from dolfinx.fem.petsc import (assemble_matrix, assemble_vector, create_matrix,
                               create_vector)
from mpi4py import MPI
from petsc4py import PETSc


def read_problem(path):
    """The file that bench/contest/problem.h describes: header, tensor a cell, u a node."""
    header = {}
    with open(path, "rb") as file:
        for line in iter(file.readline, b"data\n"):
            name, *values = line.split()
            header[name.decode()] = [float(value) for value in values]
        dimension = int(header["dimension"][0])
        cells = [int(count) for count in header["cells"][:dimension]]
        entries = dimension * (dimension + 1) // 2
        tensor = np.fromfile(file, np.float32, int(np.prod(cells)) * entries)
        nodes = [count + 1 for count in cells]
        u = np.fromfile(file, np.float32, int(np.prod(nodes))).astype(float)
    return {
        "cells": cells,
        "spacing": header["spacing"][:dimension],
        "gamma": header["gamma"][0],
        "tensor": tensor.reshape(-1, entries).astype(float),
        "u": u,
    }


def lattice_index(points, counts, spacing, offset):
    """Numbers, x fastest, of points of a lattice."""
    index = np.zeros(len(points), dtype=np.int64)
    for axis in reversed(range(len(counts))):
        place = np.rint(points[:, axis] / spacing[axis] - offset).astype(np.int64)
        index = index * counts[axis] + place
    return index


class Step:
    def __init__(self, problem, options):
        cells, spacing = problem["cells"], problem["spacing"]
        dimension = len(cells)
        corner = [count * h for count, h in zip(cells, spacing)]
        if dimension == 2:
            domain = mesh.create_rectangle(MPI.COMM_SELF, [np.zeros(2), np.array(corner)],
                                           cells, mesh.CellType.quadrilateral)
        else:
            domain = mesh.create_box(MPI.COMM_SELF, [np.zeros(3), np.array(corner)],
                                     cells, mesh.CellType.hexahedron)
        linear = ufl.FiniteElement("Q", domain.ufl_cell(), 1)
        space = fem.FunctionSpace(domain, ufl.MixedElement([linear, linear]))
        tensors = fem.FunctionSpace(
            domain, ufl.TensorElement("DG", domain.ufl_cell(), 0, symmetry=True))
        a = fem.Function(tensors)
        order = lattice_index(
            mesh.compute_midpoints(domain, dimension, np.arange(int(np.prod(cells)), dtype=np.int32)),
            cells, spacing, 0.5)
        a.x.array[:] = problem["tensor"][order].ravel()

        scalar, self.u_of = space.sub(0).collapse()
        self.w_of = space.sub(1).collapse()[1]
        self.node = lattice_index(scalar.tabulate_dof_coordinates(),
                                  [count + 1 for count in cells], spacing, 0.0)
        self.x = fem.Function(space)
        self.before = fem.Function(space)
        self.u_start = problem["u"][self.node]

        lumped = ufl.dx(metadata={"quadrature_rule": "GLL", "quadrature_degree": 1})
        u, w = ufl.split(self.x)
        u_before, _ = ufl.split(self.before)
        v, z = ufl.TestFunctions(space)
        gamma = fem.Constant(domain, problem["gamma"])
        self.tau = fem.Constant(domain, 1.0)
        potential = (2 * u * (u**2 - 1) * z * lumped
                     + gamma * ufl.inner(a * ufl.grad(u), ufl.grad(z)) * ufl.dx)
        form = ((u - u_before) * v * lumped
                + self.tau * ufl.inner(ufl.grad(w), ufl.grad(v)) * ufl.dx
                + potential - w * z * lumped)
        flags = {"cffi_extra_compile_args": ["-O3", "-march=native"]}
        self.residual = fem.form(form, jit_params=flags)
        self.jacobian = fem.form(ufl.derivative(form, self.x), jit_params=flags)
        self.first_potential = fem.form(potential, jit_params=flags)
        self.weights = fem.form(v * lumped + z * lumped, jit_params=flags)
        self.energy_form = fem.form(
            (u**2 - 1) ** 2 / 2 * lumped
            + gamma / 2 * ufl.inner(a * ufl.grad(u), ufl.grad(u)) * ufl.dx,
            jit_params=flags)
        self.matrix = create_matrix(self.jacobian)
        self.vector = create_vector(self.residual)
        self.update = self.matrix.createVecRight()

        settings = PETSc.Options()
        for option in options:
            name, _, value = option.lstrip("-").partition("=")
            settings[name] = value
        self.solver = PETSc.KSP().create(MPI.COMM_SELF)
        self.solver.setOperators(self.matrix)
        self.solver.setFromOptions()
        if self.solver.getPC().getType() == "fieldsplit":
            self.solver.getPC().setFieldSplitIS(
                ("w", PETSc.IS().createGeneral(np.array(self.w_of, dtype=np.int32))),
                ("u", PETSc.IS().createGeneral(np.array(self.u_of, dtype=np.int32))))
        self.mass = assemble_vector(self.weights).array

    def start(self):
        """The density before the step as first guess, with its own potential."""
        self.x.x.array[:] = 0.0
        self.x.x.array[self.u_of] = self.u_start
        first = assemble_vector(self.first_potential).array
        self.x.x.array[self.w_of] = first[self.w_of] / self.mass[self.w_of]
        self.before.x.array[:] = self.x.x.array

    def residual_norm(self):
        with self.vector.localForm() as local:
            local.set(0.0)
        assemble_vector(self.vector, self.residual)
        return self.vector.norm()

    def newton(self, assembled=False):
        """One Newton step, `assembled` when the residual is; the linear iterations."""
        if not assembled:
            self.residual_norm()
        self.matrix.zeroEntries()
        assemble_matrix(self.matrix, self.jacobian)
        self.matrix.assemble()
        self.solver.setOperators(self.matrix)
        self.solver.solve(self.vector, self.update)
        self.x.x.array[:] -= self.update.array
        return self.solver.getIterationNumber()

    def energy(self):
        return fem.assemble_scalar(self.energy_form)

    def distance(self, other):
        """Mass-weighted rms of u - other, whose order is that of u_of."""
        mass = self.mass[self.u_of]
        difference = self.x.x.array[self.u_of] - other
        return float(np.sqrt(np.sum(mass * difference**2) / np.sum(mass)))


def least_step(step, tau, reference_path, wanted, repetitions):
    reference = np.fromfile(reference_path, np.float64)
    step.tau.value = tau
    step.start()
    change = step.distance(reference[step.node])
    most_newton, count, error = 60, 0, 1.0
    while count < most_newton and error > wanted:
        step.newton()
        count += 1
        error = step.distance(reference[step.node]) / change
    least = least_wall = float("inf")
    for _ in range(repetitions):
        step.start()
        processor, wall = time.process_time(), time.perf_counter()
        linear = sum(step.newton() for _ in range(count))
        least = min(least, time.process_time() - processor)
        least_wall = min(least_wall, time.perf_counter() - wall)
    reached = "" if error <= wanted else " (not reached)"
    print(f"cpu {least:.5f} wall {least_wall:.5f} error {error:.2e} change {change:.4f} "
          f"MB {megabytes():.0f} iterations {count} Newton, {linear} linear{reached}")


def whole_run(step, tau, until, output):
    accuracy, tolerance, most_newton, wanted_newton = 0.05, 1e-2, 8, 4
    most_growth, most_shrinkage, reject_factor = 2.0, 0.4, 0.5
    after_reject, relaxation, limit = 0.75, 1.3, float("inf")
    step.start()
    processor, wall = time.process_time(), time.perf_counter()
    now, energy = 0.0, step.energy()
    accepted = rejected = newton = linear = 0
    earlier, last = None, 0.0
    x = step.x.x.array
    while now < until:
        size = min(tau, limit, until - now)
        step.tau.value = size
        before = x.copy()
        step.before.x.array[:] = before
        if earlier is not None:
            x[:] += min(size / last, 2.0) * (before - earlier)
        first = norm = step.residual_norm()
        count = 0
        while norm > tolerance * first and count < most_newton:
            linear += step.newton(assembled=True)
            norm = step.residual_norm()
            count += 1
        newton += count
        change, after = step.distance(before[step.u_of]), step.energy()
        if norm <= tolerance * first and change <= 3 * accuracy and after <= energy:
            now, last, energy, earlier = now + size, size, after, before
            accepted += 1
            factor = min(accuracy / change, (wanted_newton / max(count, 1)) ** 0.5)
            tau = size * min(max(factor, most_shrinkage), most_growth)
            limit *= relaxation
        else:
            x[:] = before
            earlier, tau, limit = None, reject_factor * size, after_reject * size
            rejected += 1
    u = np.empty(len(step.node))
    u[step.node] = x[step.u_of]
    u.tofile(output)
    print(f"cpu {time.process_time() - processor:.3f} wall "
          f"{time.perf_counter() - wall:.3f} MB {megabytes():.0f} t {now:.6e} "
          f"E {energy:.6f} steps {accepted} rejected {rejected} Newton {newton} "
          f"linear {linear}")


def megabytes():
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def main():
    if len(sys.argv) > 6 and sys.argv[2] == "step":
        step = Step(read_problem(sys.argv[1]), sys.argv[7:])
        least_step(step, float(sys.argv[3]), sys.argv[4], float(sys.argv[5]),
                   int(sys.argv[6]))
    elif len(sys.argv) > 5 and sys.argv[2] == "run":
        step = Step(read_problem(sys.argv[1]), sys.argv[6:])
        whole_run(step, float(sys.argv[3]), float(sys.argv[4]), sys.argv[5])
    else:
        sys.exit(__doc__)


main()
