// What `fit` found, to look at: landmarks given and guessed, lids, mouth and eyes from the front and the side, the thickness
// of tissue as colour, and the bone it was laid on.
#pragma once

#include "core/image.h"
#include "geom/polygon_mesh.h"
#include "rig/rig_description.h"
#include "sim/face.h"

namespace risorius::app {

/// How the bone lies under the skin.
struct BoneFigures {
    double thinnest_mm = 0, thickest_mm = 0, mean_mm = 0;  ///< tissue between them, at the nodes
    int through_skin = 0;  ///< nodes of bone that are not inside of the skin
};
BoneFigures bone_figures(const sim::Face& face);

Image fit_picture(const sim::Face& face, const rig::RigDescription& rig,
                  const geom::PolygonMesh& mesh);

}  // namespace risorius::app
