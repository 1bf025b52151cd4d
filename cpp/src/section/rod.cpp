#include "cdcr/robot.hpp"
#include "section/rod_body.hpp"
#include "section/rod_part_body.hpp"

// The rods that the recursions run on, compiled once.

namespace cdcr::detail {

template struct Rod<double>;
template void Rod<double>::update_velocity<false>(const SectionParameters&, const Vector3d&,
                                                  const double*);
template void Rod<double>::update_velocity<true>(const SectionParameters&, const Vector3d&,
                                                 const double*);
template struct RodPart<double>;

}  // namespace cdcr::detail
