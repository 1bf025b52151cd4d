// Text as a robot file: a robot that is one, or a sentence.
#include "cdcr/robot.hpp"
#include "cdcr/robot_file.hpp"
#include "input.hpp"

namespace cdcr::fuzz {
namespace {

void read(std::string_view text) {
  const std::string where = "the file";
  Robot robot;
  try {
    robot = robot_from_toml(text, where);
  } catch (const std::invalid_argument& refusal) {
    demand(std::string(refusal.what()).rfind(where, 0) == 0,
           "a refusal that does not name the file");
    return;
  }
  demand(violations(robot).empty(), "a robot read that is none");
}

}  // namespace
}  // namespace cdcr::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  cdcr::fuzz::read({reinterpret_cast<const char*>(data), size});
  return 0;
}
