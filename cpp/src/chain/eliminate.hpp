#pragma once

#include "chain/inertia.hpp"
#include "section/width.hpp"

// NOLINTBEGIN(bugprone-implicit-widening-of-multiplication-result,readability-identifier-naming):
// counts of rows and coordinates, all small; letters of the equations

namespace cdcr::detail {

/// The coordinates q of one section, eliminated: what its base and the rest of the chain feel of
/// them, and their accelerations once those of the base are known (eqs. (31), (32)). With D the
/// section's articulated mass, D = L E L^T, E diagonal, and what the rest feels is kept times L^-T.
template <class Section>
struct Eliminated {
  using S = typename Section::Scalar;
  using Vectorm = typename Section::Vectorm;
  using Matrixm = typename Section::Matrixm;
  using Matrix3m = typename Section::Matrix3m;

  // Nothing is set at first, since only some of many are used.
  /// Moment and force on the base that an acceleration of q needs, to be set before solve(), the
  /// first where the base may turn.
  Eigen::Map<Matrix3m> moment(Index columns) { return {U_omega.data(), 3, columns}; }
  Eigen::Map<Matrix3m> force(Index columns) { return {U_v.data(), 3, columns}; }

  /// The articulated mass, and the force on q at rest.
  void set(const Matrixm& D, const Vectorm& b) {
    size = D.cols();
    for (Index k = 0; k < size; ++k) {
      for (Index i = k; i < size; ++i) factor[max_m * k + i] = D(i, k);
      rows[num_rows * k + 3] = b[k];
    }
  }
  void solve(bool turns) {
    for (Index k = 0; k < size; ++k) {
      S* row = rows.data() + num_rows * k;
      for (Index c = 0; c < 3; ++c) row[c] = U_v[3 * k + c];
      for (Index c = 0; turns && c < 3; ++c) row[4 + c] = U_omega[3 * k + c];
      row[7] = S(0.0);
    }
    with_fma<S>([&] {
      if (turns) {
        factorize(std::integral_constant<int, num_rows>());
      } else {
        factorize(std::integral_constant<int, 4>());
      }
    });
  }
  void take_from(Articulated<S>& a) const {
    alignas(row_alignment) Eigen::Matrix<S, num_rows, 7> sum;
    with_fma<S>([&] {
      for (Index j = 0; j < 7; ++j) {
        constexpr int num_packs = num_rows / Rows<S>::count;
        typename Rows<S>::Pack column[num_packs];  // NOLINT(modernize-avoid-c-arrays): a typedef
        Rows<S>::clear(column, num_packs);
        for (Index k = 0; k < size; ++k) {
          const S share = rows[num_rows * k + j] * inverse[k];
          const auto* row = packs_of(rows.data() + num_rows * k);
          for (int i = 0; i < num_packs; ++i) {
            column[i] += share * row[i];
          }
        }
        for (int i = 0; i < num_packs; ++i) packs_of(sum.data() + num_rows * j)[i] = column[i];
      }
    });
    a.J -= sum.template block<3, 3>(4, 4);
    a.G -= sum.template block<3, 3>(4, 0);
    a.M -= sum.template block<3, 3>(0, 0);
    a.moment -= sum.template block<3, 1>(4, 3);
    a.force -= sum.template block<3, 1>(0, 3);
  }
  [[nodiscard]] Vectorm acceleration(const Vector3<S>& omega, const Vector3<S>& v,
                                     bool turns) const {
    Vectorm a(size);
    for (Index k = 0; k < size; ++k) {
      const S* row = rows.data() + num_rows * k;
      a[k] = -row[3] - row[0] * v[0] - row[1] * v[1] - row[2] * v[2];
      if (turns) a[k] -= row[4] * omega[0] + row[5] * omega[1] + row[6] * omega[2];
    }
    for (Index k = size - 1; k >= 0; --k) {
      a[k] *= inverse[k];
      for (Index j = 0; j < k; ++j) a[j] -= factor[max_m * j + k] * a[k];
    }
    return a;
  }

 private:
  static constexpr int num_rows = 8;  // three of U_v, b, three of U_omega; one more to be even

  /// With this many rows.
  template <int count>
  void factorize(std::integral_constant<int, count> /*rows*/) {
    for (Index k = 0; k < size; ++k) {
      const S* from = factor.data() + max_m * k;
      const S* row = rows.data() + num_rows * k;
      inverse[k] = 1.0 / from[k];
      for (Index j = k + 1; j < size; ++j) {
        S* to = factor.data() + max_m * j;
        S* row_j = rows.data() + num_rows * j;
        const S share = from[j] * inverse[k];
        for (Index i = j; i < size; ++i) to[i] -= share * from[i];
        for (int i = 0; i < count / Rows<S>::count; ++i) {
          packs_of(row_j)[i] -= share * packs_of(row)[i];
        }
      }
    }
  }

  static constexpr int max_m = Section::max_m;
  Index size;
  std::array<S, 3 * max_m> U_omega, U_v;
  std::array<S, max_m * max_m> factor;  // L E: column k from max_m k on, its lower half
  std::array<S, max_m> inverse;         // of E
  alignas(row_alignment) std::array<S, num_rows * max_m> rows;
};

}  // namespace cdcr::detail

// NOLINTEND(bugprone-implicit-widening-of-multiplication-result,readability-identifier-naming)
