#include "derivatives/dual.hpp"
#include "section/rod_body.hpp"
#include "section/rod_part_body.hpp"

namespace cdcr::detail {

template struct Rod<Dual>;
template void Rod<Dual>::update_velocity<false>(const SectionParameters&, const Vector3<Dual>&,
                                                const Dual*);
template void Rod<Dual>::update_velocity<true>(const SectionParameters&, const Vector3<Dual>&,
                                               const Dual*);
template struct RodPart<Dual>;

}  // namespace cdcr::detail
