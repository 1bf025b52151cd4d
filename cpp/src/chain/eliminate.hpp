#pragma once

#include "chain/inertia.hpp"

namespace cdcr::detail {

/// The coordinates q of one section, eliminated: what its base and the rest of the chain feel of
/// them, and their accelerations once those of the base are known (eqs. (31), (32)). D is the
/// section's articulated mass, b the force on q at rest.
template <class Section, int m = Section::m>
struct Eliminated {
  using S = typename Section::Scalar;
  using Vectorm = typename Section::Vectorm;
  using Matrixm = typename Section::Matrixm;
  using Matrix3m = typename Section::Matrix3m;

  Matrix3m U_omega, U_v;  // force on the base that an acceleration of q needs
  Matrixm inverse;        // of D
  Vectorm u;              // D^-1 b

  /// With U_v known, and U_omega where the base may turn.
  void solve(const Matrixm& D, const Vectorm& b, bool /*turns*/) {
    inverse = inverse_of(D);
    u = inverse.lazyProduct(b);
  }
  void take_from(Articulated<S>& a) const {
    const Matrix3m UD = U_omega.lazyProduct(inverse), VD = U_v.lazyProduct(inverse);
    a.J -= UD.lazyProduct(U_omega.transpose());
    a.G -= UD.lazyProduct(U_v.transpose());
    a.M -= VD.lazyProduct(U_v.transpose());
    a.force -= U_v.lazyProduct(u);
    a.moment -= U_omega.lazyProduct(u);
  }
  [[nodiscard]] Vectorm acceleration(const Vector3<S>& omega, const Vector3<S>& v,
                                     bool turns) const {
    Vectorm w = U_v.transpose().lazyProduct(v);
    if (turns) w += U_omega.transpose().lazyProduct(omega);
    return -u - inverse.lazyProduct(w);
  }

 private:
  /// Inverse of a symmetric positive definite matrix.
  [[nodiscard]] static Matrixm inverse_of(const Matrixm& D) {
    if constexpr (m == 2) {
      const S factor = 1.0 / (D(0, 0) * D(1, 1) - D(0, 1) * D(0, 1));
      const S across = -D(0, 1) * factor;
      Matrixm inverse;
      inverse << D(1, 1) * factor, across, across, D(0, 0) * factor;
      return inverse;
    } else {
      return D.llt().solve(Matrixm::Identity(D.rows(), D.rows()));
    }
  }
};

/// The same for many coordinates: D = L E L^T, E diagonal, and what the rest feels times L^-T.
template <class Section>
struct Eliminated<Section, Eigen::Dynamic> {
  using S = typename Section::Scalar;
  using Vectorm = typename Section::Vectorm;
  using Matrixm = typename Section::Matrixm;
  using Matrix3m = typename Section::Matrix3m;

  Matrix3m U_omega, U_v;

  void solve(const Matrixm& D, const Vectorm& b, bool turns) {
    const Index size = D.cols();
    factor = D;
    rows.resize(num_rows, size);
    for (Index k = 0; k < size; ++k) {
      for (Index c = 0; c < 3; ++c) {
        rows(c, k) = turns ? U_omega(c, k) : S(0.0);
        rows(3 + c, k) = U_v(c, k);
      }
      rows(6, k) = b[k];
      rows(7, k) = S(0.0);
    }
    inverse.resize(size);
    for (Index k = 0; k < size; ++k) {
      inverse[k] = 1.0 / factor(k, k);
      for (Index j = k + 1; j < size; ++j) {
        const S share = factor(j, k) * inverse[k];
        for (Index i = j; i < size; ++i) factor(i, j) -= share * factor(i, k);
        for (Index i = 0; i < num_rows; ++i) rows(i, j) -= share * rows(i, k);
      }
    }
  }
  void take_from(Articulated<S>& a) const {
    Eigen::Matrix<S, 6, num_rows> sum;
    sum.setZero();
    for (Index k = 0; k < rows.cols(); ++k) {
      for (Index j = 0; j < 7; ++j) {
        const S share = rows(j, k) * inverse[k];
        for (Index i = 0; i < 6; ++i) sum(i, j) += share * rows(i, k);
      }
    }
    a.J -= sum.template block<3, 3>(0, 0);
    a.G -= sum.template block<3, 3>(0, 3);
    a.M -= sum.template block<3, 3>(3, 3);
    a.moment -= sum.template block<3, 1>(0, 6);
    a.force -= sum.template block<3, 1>(3, 6);
  }
  [[nodiscard]] Vectorm acceleration(const Vector3<S>& omega, const Vector3<S>& v, bool) const {
    const Index size = rows.cols();
    Vectorm a(size);
    for (Index k = size - 1; k >= 0; --k) {
      S sum = -rows(6, k);
      for (Index c = 0; c < 3; ++c) sum -= rows(c, k) * omega[c] + rows(3 + c, k) * v[c];
      // Column k of the factor is that of L, times E.
      for (Index j = k + 1; j < size; ++j) sum -= factor(j, k) * a[j];
      a[k] = sum * inverse[k];
    }
    return a;
  }

 private:
  static constexpr int num_rows = 8;  // three of U_omega, three of U_v, b; one more for alignment

  Matrixm factor;   // L E in the lower half
  Vectorm inverse;  // of E
  Eigen::Matrix<S, num_rows, Eigen::Dynamic, Eigen::ColMajor, num_rows, Section::max_m> rows;
};

}  // namespace cdcr::detail
