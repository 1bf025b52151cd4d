#include "cdcr/status.hpp"

namespace cdcr {

const char* message(Status status) noexcept {
  switch (status) {
    case Status::ok:
      return "";
    case Status::not_started:
      return "No state has been set: call reset with a state first.";
    case Status::step_limit:
      return "The run needed more than max_steps internal steps: raise max_steps.";
    case Status::step_too_small:
      return "The step size fell to rounding level: the motion changes too abruptly here. Check "
             "the commands of the cables for a jump that is not a break point of a table, or "
             "loosen rtol.";
    case Status::tolerance_not_met:
      return "The implicit solver could not converge: loosen rtol and atol, or use method dopri5.";
    case Status::non_finite_state:
      return "The state became infinite or not a number: check the commands of the cables and "
             "the initial state, and use a smaller step where it is fixed.";
    case Status::bending_limit:
      return "A section bent beyond 3 pi rad, past the model's validity: pull the cables less, or "
             "lessen whatever else bends it.";
    case Status::invalid_tension:
      return "The commands of the cables, tensions or lengths, must be finite, not negative, and "
             "one for each cable; the state was left as it was.";
    case Status::not_converged:
      return "No equilibrium was found: start nearer to it with q0, or pull the cables less; the "
             "robot may have none within the bending limit.";
    case Status::interrupted:
      return "The run was stopped before its end; the samples up to then are kept.";
    case Status::event:
      return "An event that ends the run happened.";
    case Status::wrong_size:
      return "A vector has another size than the robot it is for: q and qd have one value for each "
             "coordinate, commands one for each cable.";
    case Status::invalid_wrench:
      return "A wrench must be finite and act on a section of the robot at a fraction from 0 to 1; "
             "the state was left as it was.";
    case Status::compression_limit:
      return "A section was compressed below a tenth of its length, past the model's validity: "
             "pull the cables less, or lessen whatever else compresses it.";
  }
  return "Unknown status.";
}

const char* name(Status status) noexcept {
  switch (status) {
    case Status::ok:
      return "ok";
    case Status::not_started:
      return "not_started";
    case Status::step_limit:
      return "step_limit";
    case Status::step_too_small:
      return "step_too_small";
    case Status::tolerance_not_met:
      return "tolerance_not_met";
    case Status::non_finite_state:
      return "non_finite_state";
    case Status::bending_limit:
      return "bending_limit";
    case Status::invalid_tension:
      return "invalid_tension";
    case Status::not_converged:
      return "not_converged";
    case Status::interrupted:
      return "interrupted";
    case Status::event:
      return "event";
    case Status::wrong_size:
      return "wrong_size";
    case Status::invalid_wrench:
      return "invalid_wrench";
    case Status::compression_limit:
      return "compression_limit";
  }
  return "unknown";
}

}  // namespace cdcr
