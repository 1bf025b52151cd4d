#pragma once

#include <Eigen/Core>

#include "cdcr/eigen_abi.hpp"
#include "cdcr/export.hpp"

namespace CDCR_EXPORT cdcr {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// A frame in another one: rotation matrix and position [m], and 0, 0, 0, 1 below. Not aligned, so
/// that what holds it is laid out alike under all flags.
using Transform = Eigen::Matrix<double, 4, 4, Eigen::DontAlign>;

/// Largest bending angle of a section [rad]: one and a half turns. The section's polynomials end
/// there, and functions of the shape return NaN beyond it.
inline constexpr double max_bending = 3.0 * 3.14159265358979323846;

/// Read-only vector argument; binds to a VectorXd, a segment or a Map without a copy.
using ConstVectorRef = Eigen::Ref<const VectorXd>;
/// Caller-owned output vector; it must already have its size.
using VectorRef = Eigen::Ref<VectorXd>;
/// Caller-owned output matrix; it must already have its size.
using MatrixRef = Eigen::Ref<MatrixXd>;
/// One sample in each row, C-contiguous, as NumPy lays it out.
using RowMatrixXd = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

}  // namespace CDCR_EXPORT cdcr
