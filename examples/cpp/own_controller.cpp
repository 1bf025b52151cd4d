// A controller of one's own, as in examples/08_own_controller.py: computed torque along a circle.
// The error e = q - q_ref obeys e'' + 2 w e' + w^2 e = 0.
#include <cdcr/cdcr.hpp>
#include <cmath>
#include <cstdio>

namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double w = 6.0;                   // [rad/s]
constexpr double bent = 40.0 * pi / 180;    // [rad]
constexpr double turning = 2.0 * pi / 3.0;  // [rad/s]

/// Bending vector that goes round a circle, its rate and its acceleration.
struct Reference {
  explicit Reference(double t)
      : q(bent * std::cos(turning * t), bent * std::sin(turning * t)),
        qd(-turning * q.y(), turning * q.x()),
        qdd(-turning * turning * q) {}
  Eigen::Vector2d q, qd, qdd;
};

class ComputedTorque : public cdcr::Controller {
 public:
  explicit ComputedTorque(const cdcr::Model& model)
      : model_(model), data_(model), allocator_(model, limits()), qdd_(2), moment_(2) {}

  void reset() noexcept override {}
  cdcr::Status update(double t, const cdcr::ConstVectorRef& q, const cdcr::ConstVectorRef& qd,
                      cdcr::VectorRef tension) noexcept override {
    const Reference reference(t);
    qdd_ = reference.qdd - 2.0 * w * (qd - reference.qd) - w * w * (q - reference.q);
    cdcr::inverse_dynamics(model_, data_, q, qd, qdd_, moment_);
    if (!allocator_.solve(moment_)) return cdcr::Status::not_converged;
    tension = allocator_.tension();
    return cdcr::Status::ok;
  }
  double period() const noexcept override { return 2e-3; }  // [s]
  cdcr::Index num_coordinates() const noexcept override { return model_.num_coordinates(); }
  cdcr::Index num_cables() const noexcept override { return model_.num_cables(); }
  bool gives_tensions() const noexcept override { return true; }

 private:
  static cdcr::TensionLimits limits() {
    cdcr::TensionLimits limits;
    limits.min_tension = 0.5;  // [N]
    return limits;
  }

  cdcr::Model model_;
  cdcr::Data data_;
  cdcr::Allocator allocator_;
  cdcr::VectorXd qdd_, moment_;
};

}  // namespace

int main() {
  cdcr::Robot robot = cdcr::amouri2020();
  robot.gravity = {0.0, 0.0, -9.81};
  robot.sections[0].damping = 5e-3;
  const cdcr::Model model(robot);

  // Straight and at rest, so far off.
  ComputedTorque controller(model);
  const cdcr::VectorXd straight = cdcr::VectorXd::Zero(2);
  const cdcr::VectorXd times = cdcr::VectorXd::LinSpaced(501, 0.0, 5.0);
  const cdcr::Trajectory run = cdcr::simulate(model, straight, straight, times, controller);
  if (run.status != cdcr::Status::ok) {
    std::fprintf(stderr, "%s\n", run.message.c_str());
    return 1;
  }

  const double t = 0.5;
  const Eigen::Vector2d error = run.q.row(50).transpose() - Reference(t).q;
  const Eigen::Vector2d e0 = -Reference(0.0).q, v0 = -Reference(0.0).qd;
  const Eigen::Vector2d chosen = (e0 + (v0 + w * e0) * t) * std::exp(-w * t);
  std::printf("error after %.1f s: %.2f deg, chosen: %.2f deg\n", t, error.norm() * 180.0 / pi,
              chosen.norm() * 180.0 / pi);
  std::printf("largest tension: %.1f N\n", run.tension.maxCoeff());
  return 0;
}
