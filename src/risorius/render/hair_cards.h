// SPDX-License-Identifier: MIT
/// \file
/// The hair of a head for other programs: cards over a cap. A card is the strip of a lock (detail/locks.h) with a picture of
/// strands, whose alpha cuts its rims and its end. The cap is opaque and has the same picture.
#pragma once

#include <vector>

#include "risorius/core/image.h"
#include "risorius/core/types.h"
#include "risorius/render/scene.h"

namespace risorius::render {

struct HairCards {
    Points vertices;            ///< C x 3, m, head frame, at rest
    Points normals;             ///< C x 3, of unit length: away from the head
    TexCoords texcoords;        ///< C x 2, in 0..1, (0, 0) is the lower left corner
    std::vector<double> shade;  ///< C, 0..1, linear: factor of the picture, dark at the roots
    Triangles cards, cap;       ///< counter-clockwise from outside
    /// C x 3: the triangle of the scene's skin that a vertex follows, and the share of its corners
    Triangles root;
    Points share;
    long locks = 0;

    bool empty() const { return vertices.rows() == 0; }
    /// Where the cards are moved to when the skin moves by `delta`, V x 3, but does not turn: C x 3, m.
    Points moved(const Points& delta) const;
};

/// Returns the hair of the scene's appearance, none where locks.h plans none.
HairCards hair_cards(const Scene& scene);

/// The least alpha of what is hair in the picture: what is below is to be left out.
inline constexpr double kHairAlpha = 0.45;

/// Returns the picture of the strands, with the colour of the hair, its white hairs included. Strands run upright, with roots
/// at the top; alpha is 1 but at the rims of cards and at their ends, which are at the bottom.
Image hair_card_picture(const Appearance& appearance);

}  // namespace risorius::render
