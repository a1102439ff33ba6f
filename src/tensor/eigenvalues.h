/* Eigenvalues of symmetric 3 x 3 matrices. */
#ifndef FG__EIGENVALUES_H
#define FG__EIGENVALUES_H

/* Writes the eigenvalues of the symmetric matrix with entries xx, xy, yy, zz, xz, yz in
 * descending order. Two that are equal come out within 3e-8 of the largest entry (the
 * square root of the rounding error), others to rounding.
 * O. K. Smith, Communications of the ACM 4 (1961) 168. */
void fg__eigenvalues(double eigenvalue[3], const double matrix[6]);

#endif
