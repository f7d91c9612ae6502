// SPDX-License-Identifier: MIT
/// \file
/// Simulates equilibria under weights of units on several equal faces at once, and what points do in them.
///
/// Every equilibrium starts from rest, or from one that was found before and is kept, so that results do not depend on the number of
/// faces.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "risorius/core/progress_monitor.h"
#include "risorius/face/face_team.h"
#include "risorius/face/statics.h"
#include "risorius/inverse/detail/unit_model.h"
#include "risorius/inverse/detail/unit_sources.h"

namespace risorius::inverse {

/// An equilibrium under weights that was found earlier, from which a search may begin.
struct KnownUnits {
    UnitState state;
    Points nodes;  ///< face::KeptEquilibrium::nodes
};

class UnitBench {
  public:
    /// `vertices`: the points. All references must outlive the bench.
    UnitBench(face::FaceTeam& team, const UnitSources& sources, std::vector<int> vertices);

    /// The displacements of the points under each of a list of weights. Throws Interrupted.
    std::vector<Eigen::VectorXd> moved(const std::vector<Eigen::VectorXd>& weights,
                                       const ProgressMonitor& monitor) const;

    /// The equilibrium under weights, with the derivatives of the points by the weights of all sources. Throws Interrupted.
    KnownUnits state(const Eigen::VectorXd& weight, const ProgressMonitor& monitor) const;

    /// What is known of a rig before anything is sought. First the face at rest with the unit shapes: what each source moves at part of its
    /// weight, over that part. Both sides of a unit are simulated at once, and what they move is shared between them. Then expressions
    /// that people show, each with its derivatives. Kept in the cache for the next run with this rig.
    std::vector<KnownUnits> known(const scene::RigFiles& files, const std::string& quality,
                                  const ProgressMonitor& monitor) const;

    const std::vector<int>& vertices() const { return vertices_; }
    const UnitSources& sources() const { return sources_; }

    /// Equilibria of a search, each sought from the nearest one that is known, which takes a third of the time of one from rest, or less.
    /// Where each begins depends on the calls alone, and not on the faces or threads.
    class Search {
      public:
        /// `known`: of the bench, the rest first.
        Search(const UnitBench& bench, const std::vector<KnownUnits>& known);
        /// The displacements of the points under weights.
        Eigen::VectorXd moved(const Eigen::VectorXd& weight, const ProgressMonitor& monitor);
        /// Those under each of a list, in kWalks pieces at once: list weights in the order of a motion. Each piece begins with the weights
        /// that are nearest to what was found before the call.
        std::vector<Eigen::VectorXd> moved(const std::vector<Eigen::VectorXd>& weights,
                                           const ProgressMonitor& monitor);
        /// The equilibrium with the derivatives of the points by the weights of the `wanted` sources. Those of the others are 0.
        UnitState state(const Eigen::VectorXd& weight, const std::vector<bool>& wanted,
                        const ProgressMonitor& monitor);

      private:
        struct Found {
            Eigen::VectorXd weight;
            face::KeptEquilibrium at;
        };
        double apart(const Found& found, const Eigen::VectorXd& weight) const;
        /// The number of the nearest one.
        std::size_t nearest(const std::vector<Found>& found, const Eigen::VectorXd& weight) const;

        const UnitBench& bench_;
        /// Of what each weight moves: it makes distances of weights distances of the points
        Eigen::ArrayXd size_;
        std::vector<Found> found_;
        bool first_is_there_ = false;  ///< the first face of the team is in the last of them
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
    /// The same by all inputs and then by the sources, in two tasks at once. `place` puts a face into the equilibrium for a task, 0 or 1.
    Eigen::MatrixXd derivatives(const Inputs& inputs,
                                const std::function<void(int task, face::Face& face)>& place) const;
    void go_to(face::Face& face, const Eigen::VectorXd& weight,
               const ProgressMonitor& monitor) const;
    /// From where the face is.
    void go_on_to(face::Face& face, const Eigen::VectorXd& weight,
                  const ProgressMonitor& monitor) const;
    std::vector<Eigen::VectorXd> usual_weights(const scene::RigFiles& files) const;
    std::string key_of(const scene::RigFiles& files, const std::string& quality) const;
    Eigen::VectorXd displacement(const Points& vertices) const;  ///< of the points, m
    Eigen::MatrixXd unit_shapes(const ProgressMonitor& monitor) const;
    Points at_rest() const;        ///< the points, m
    Points nodes_at_rest() const;  ///< puts the first face there

    face::FaceTeam& team_;
    const UnitSources& sources_;
    std::vector<int> vertices_;
};

}  // namespace risorius::inverse
