#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>

#include "cdcr/model.hpp"
#include "setup_file.hpp"
#include "variables.hpp"

namespace cdcr::fmu {

/// Throws std::invalid_argument with the sentence unless the condition holds.
void need(bool condition, const char* sentence);
/// A text that a caller may have left out.
[[nodiscard]] std::string given(const char* text);

/// One robot in a co-simulation, whatever the version of FMI.
///
/// Everything here throws std::exception with a sentence; what it threw in has changed nothing.
class Instance {
 public:
  /// `resources`: the folder of that name in the unpacked FMU.
  Instance(const std::string& resources, const std::string& token);

  void enter_initialization(double start, double stop = infinite);
  void exit_initialization();
  /// From t by h under the commands set before. Between two calls nothing is kept but the state.
  void step(double t, double h);
  void terminate();
  void reset();

  void set(const std::uint32_t* references, std::size_t count, const double* values);
  void get(const std::uint32_t* references, std::size_t count, double* values);
  /// First derivatives of outputs by time, the commands held.
  void output_derivatives(const std::uint32_t* references, std::size_t count, const int* orders,
                          double* values);
  /// Sensitivity of unknowns to a seed of knowns, or with `adjoint` of knowns to one of unknowns.
  void derivative(const std::uint32_t* unknowns, std::size_t num_unknowns,
                  const std::uint32_t* knowns, std::size_t num_knowns, const double* seed,
                  double* sensitivity, bool adjoint = false);

  [[nodiscard]] double time() const noexcept { return kept_[0]; }
  [[nodiscard]] VectorXd save() const;
  void restore(const VectorXd& saved);
  [[nodiscard]] Index saved_size() const noexcept { return 2 + kept_.size(); }

  static constexpr double infinite = std::numeric_limits<double>::infinity();

 private:
  enum class Phase { instantiated, initialization, step, terminated };

  [[nodiscard]] auto segment(Kind kind) {
    return kept_.segment(variables_.first(kind), variables_.count(kind));
  }
  void require_phase(Phase phase, const char* sentence) const;
  void set_one(Variable variable, double value);
  void use_gravity();
  [[nodiscard]] VectorXd computed();
  [[nodiscard]] MatrixXd partials();
  [[nodiscard]] Index row(std::uint32_t reference) const;
  [[nodiscard]] Index column(std::uint32_t reference) const;

  Setup setup_;
  Model model_;
  Data data_;
  Variables variables_;
  Phase phase_ = Phase::instantiated;
  double stop_ = infinite;
  VectorXd kept_, start_;  // by value reference
};

}  // namespace cdcr::fmu
