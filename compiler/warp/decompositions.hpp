// This file decomposes small dense matrices. It is a separate file, because its templates take longer to
// compile than the rest of the folder.
#pragma once

#include <Eigen/Core>

namespace remap {

struct SymmetricEigen {
  Eigen::VectorXd values;   // n, in increasing order
  Eigen::MatrixXd vectors;  // n x n, a column for each value, of length 1
};

// Decomposes a symmetric n x n matrix. Only its lower triangle is read.
SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& matrix);

// Returns the n x m matrix x with left x = right for a symmetric, positive definite n x n matrix.
Eigen::MatrixXd solve_symmetric(const Eigen::MatrixXd& left, const Eigen::MatrixXd& right);

// Returns the orthogonal n x n matrix closest to `matrix` (n x n): U V' of its singular value decomposition
// (Schoenemann 1966, the orthogonal Procrustes problem).
Eigen::MatrixXd nearest_orthogonal(const Eigen::MatrixXd& matrix);

}  // namespace remap
