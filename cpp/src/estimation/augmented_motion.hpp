#pragma once

#include <Eigen/Cholesky>
#include <optional>
#include <vector>

#include "cdcr/model.hpp"
#include "cdcr/wrench.hpp"
#include "derivatives/base_slopes.hpp"
#include "integration/rk4.hpp"

namespace cdcr::detail {

/// What the base feels at a state x, (6), and how that changes with x, (6, size).
struct FeltBase {
  VectorXd x, wrench;
  MatrixXd slopes;
  bool known = false;
};

/// How the state that filters estimate moves: x = (q, qd, f, s), a force f at a place (3) and
/// shares s of variants, those of the two that there are, which stay; cpp/estimation.md eqs. (94),
/// (95). Real-time safe after construction.
class AugmentedMotion {
 public:
  AugmentedMotion(const Model& model, const std::vector<Model>& variants,
                  const std::optional<Place>& force_at, double period, int substeps);

  [[nodiscard]] Index size() const noexcept { return 2 * d_ + num_forces() + num_shares(); }
  [[nodiscard]] Index num_forces() const noexcept { return static_cast<Index>(3 * force_.size()); }
  [[nodiscard]] Index num_shares() const noexcept { return static_cast<Index>(models_.size()) - 1; }
  [[nodiscard]] const Model& model() const noexcept { return models_.front(); }

  /// d(qd)/dt.
  void accelerate(const ConstVectorRef& x, const VectorXd& command, VectorRef qdd) noexcept;
  /// A period on, by Runge-Kutta.
  void advance(const VectorXd& x, const VectorXd& command, VectorXd& next) noexcept;
  /// How the accelerations change with x (d, size).
  void slopes(const VectorXd& x, const VectorXd& command, MatrixXd& out) noexcept;

  /// What the base feels (6): eq. (123) of all models at the acceleration that they have together.
  void base_wrench(const VectorXd& x, const VectorXd& command, VectorRef out) noexcept;
  /// The same and how it changes with x, eq. (124), once there is room for it: at the first x that
  /// is asked for since forget_base(), so that sensors of force and of moment share it.
  const FeltBase& felt_base(const VectorXd& x, const VectorXd& command) noexcept;
  void forget_base() noexcept { felt_.known = false; }
  void make_room_for_base_wrench();

 private:
  void add_base_wrench(std::size_t k, const ConstVectorRef& x, VectorRef out) noexcept;
  [[nodiscard]] double weight(std::size_t k, const ConstVectorRef& shares) const noexcept;
  void set_mass(const ConstVectorRef& q, const ConstVectorRef& shares) noexcept;
  void set_unbalanced(std::size_t k, const ConstVectorRef& q, const ConstVectorRef& qd,
                      const VectorXd& command) noexcept;

  std::vector<Model> models_;  // the filter's own, then the variants
  std::vector<Data> data_;
  Index d_;
  double step_;
  int substeps_;
  Wrenches force_;  // one or none
  Rk4Stages stages_;
  VectorXd between_, slope_, qdd_, bias_, unbalanced_, added_;
  MatrixXd M_, own_, A_;
  Eigen::LLT<MatrixXd> llt_;
  VectorXd on_base_;  // of one model (6)
  FeltBase felt_;
  std::vector<BaseSlopes> base_slopes_;
  MatrixXd base_change_, change_;  // (6, 3d), (d, size)
};

}  // namespace cdcr::detail
