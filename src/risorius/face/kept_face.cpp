// SPDX-License-Identifier: MIT
#include "risorius/face/kept_face.h"

#include "risorius/face/detail/face_impl.h"

namespace risorius::face {

struct KeptFace::Content {
    FaceImpl::Kept moment;
    double time_s;
};

double KeptFace::time_s() const { return content_->time_s; }

std::size_t KeptFace::bytes() const {
    const FaceImpl::Kept& moment = content_->moment;
    const TissueMotion::Past& past = moment.motion;
    std::size_t numbers = 0;
    for (const Points* points :
         {&moment.now.x, &moment.before.x, &moment.earlier.x, &moment.last_move, &past.now,
          &past.before, &past.space_now, &past.space_before, &past.velocity, &past.velocity_before})
        numbers += static_cast<std::size_t>(points->size());
    for (const MuscleSolids::Factorised& one : moment.solids)
        numbers += static_cast<std::size_t>(one.at.size()) + one.with.size();
    return numbers * sizeof(double) + moment.contacts.size() * sizeof(tissue::Contacts::Memory);
}

KeptFace Face::keep() const {
    return KeptFace(
        std::make_shared<const KeptFace::Content>(KeptFace::Content{impl_->keep(), time_s()}));
}

void Face::go_back_to(const KeptFace& moment) { impl_->go_back_to(moment.content().moment); }

}  // namespace risorius::face
