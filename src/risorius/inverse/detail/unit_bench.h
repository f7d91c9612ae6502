// SPDX-License-Identifier: MIT
/// \file
/// Simulates equilibria under weights of units on several equal faces at once, and what points do in them.
///
/// Every equilibrium starts from rest, so that results do not depend on the number of faces or on the order.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>
#include <vector>

#include "risorius/core/progress_monitor.h"
#include "risorius/face/face_team.h"
#include "risorius/inverse/detail/unit_model.h"
#include "risorius/inverse/detail/unit_sources.h"

namespace risorius::inverse {

class UnitBench {
  public:
    /// `vertices`: the points. All references must outlive the bench.
    UnitBench(face::FaceTeam& team, const UnitSources& sources, std::vector<int> vertices);

    /// The displacements of the points under each of a list of weights. Throws Interrupted.
    std::vector<Eigen::VectorXd> moved(const std::vector<Eigen::VectorXd>& weights,
                                       const ProgressMonitor& monitor) const;

    /// The same, each sought from the one before it, which takes a third of the time where they are near: list them in the order of a
    /// motion. Each of kWalks faces has a piece of the list, however many threads there are.
    std::vector<Eigen::VectorXd> moved_in_turn(const std::vector<Eigen::VectorXd>& weights,
                                               const ProgressMonitor& monitor) const;

    /// The equilibrium under weights, with the derivatives of the points by the weights of all sources. Throws Interrupted.
    UnitState state(const Eigen::VectorXd& weight, const ProgressMonitor& monitor) const;

    /// What is known of a rig before anything is sought. First the face at rest with the unit shapes: what each source moves at part of its
    /// weight, over that part. Both sides of a unit are simulated at once, and what they move is shared between them. Then expressions
    /// that people show, each with its derivatives. Kept in the cache for the next run with this rig.
    std::vector<UnitState> known(const scene::RigFiles& files, const std::string& quality,
                                 const ProgressMonitor& monitor) const;

    const std::vector<int>& vertices() const { return vertices_; }
    const UnitSources& sources() const { return sources_; }

    /// Equilibria one after the other on one face, each sought from the one before it; the first from rest.
    class Walk {
      public:
        explicit Walk(const UnitBench& bench) : bench_(bench) {}
        Eigen::VectorXd moved(const Eigen::VectorXd& weight, const ProgressMonitor& monitor);
        /// The same with the derivatives of the points by the weights of the `wanted` sources. Those of the others are 0.
        UnitState state(const Eigen::VectorXd& weight, const std::vector<bool>& wanted,
                        const ProgressMonitor& monitor);

      private:
        const UnitBench& bench_;
        bool begun_ = false;
    };

  private:
    /// What changes with the weights of the wanted sources (empty: all), and the numbers of the drive that take part.
    struct Inputs {
        std::vector<track::Expansion> changes;
        std::vector<int> columns;
        std::vector<track::Kinematic> channels;
    };
    Inputs inputs_of(const Eigen::VectorXd& weight, const std::vector<bool>& wanted) const;
    /// Of the points by numbers of the drive, in the equilibrium of a face.
    Eigen::MatrixXd derivatives(face::Face& face, std::span<const int> columns,
                                std::span<const track::Kinematic> channels) const;
    Eigen::MatrixXd by_sources(const Inputs& inputs, const Eigen::MatrixXd& by) const;
    void go_to(face::Face& face, const Eigen::VectorXd& weight,
               const ProgressMonitor& monitor) const;
    /// From where the face is.
    void go_on_to(face::Face& face, const Eigen::VectorXd& weight,
                  const ProgressMonitor& monitor) const;
    std::vector<Eigen::VectorXd> usual_weights(const scene::RigFiles& files) const;
    std::string key_of(const scene::RigFiles& files, const std::string& quality) const;
    Eigen::VectorXd displacement(const Points& vertices) const;  ///< of the points, m
    Eigen::MatrixXd unit_shapes(const ProgressMonitor& monitor) const;
    Points at_rest() const;  ///< the points, m

    face::FaceTeam& team_;
    const UnitSources& sources_;
    std::vector<int> vertices_;
};

}  // namespace risorius::inverse
