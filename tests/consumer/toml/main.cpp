// A controller whose robot is a file: cdcr::toml, which needs nothing at run time.
#include <cdcr/cdcr.hpp>
#include <cdcr/robot_file.hpp>
#include <cstdio>
#include <exception>

int main(int argc, char** argv) {
  try {
    const cdcr::Model model(cdcr::load_robot(argc > 1 ? argv[1] : "robot.toml"));
    cdcr::Simulator robot(model, 1e-3);
    const cdcr::VectorXd zero = cdcr::VectorXd::Zero(model.num_coordinates());
    robot.reset(zero, zero);
    const cdcr::VectorXd tension = cdcr::VectorXd::Constant(model.num_cables(), 1.0);
    for (int period = 0; period < 100; ++period) {
      if (robot.step(tension) != cdcr::Status::ok) return 1;
    }
    std::printf("%d sections, %d cables, %.3f s\n", static_cast<int>(model.num_sections()),
                static_cast<int>(model.num_cables()), robot.time());
    return 0;
  } catch (const std::exception& error) {  // one sentence for each thing that is wrong in the file
    std::puts(error.what());
    return 2;
  }
}
