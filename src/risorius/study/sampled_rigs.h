// SPDX-License-Identifier: MIT
/// \file
/// The rigs of a study: each is the rig of the study with other numbers.
#pragma once

#include <string>
#include <vector>

#include "risorius/rig/rig_description.h"
#include "risorius/study/study_description.h"

namespace risorius::study {

/// Which rows of the study a face belongs to.
enum class Matrix {
    kNominal,  ///< the rig as it is
    kA,
    kB,
    kAB,  ///< A with one parameter from B
};

/// One face of a study.
struct Run {
    Matrix matrix = Matrix::kNominal;
    int row = 0;        ///< of A and B
    int parameter = 0;  ///< of kAB
};

class SampledRigs {
  public:
    /// Keeps a reference to the study. Draws the sample, and reads the rigs at the ends of every parameter, so that a number that
    /// leaves its range is told before any face is made. Throws Error.
    explicit SampledRigs(const StudyDescription& study);

    const std::vector<Run>& runs() const { return runs_; }
    /// "A" of A, "B" of B, the name of the parameter of AB, "rig" of the rig as it is.
    std::string matrix_name(const Run& run) const;
    /// Returns the values of a parameter in a run: one, or one for each number when it has `each`. Those of the nominal run leave the rig
    /// as it is, or are NaN when the parameter sets its numbers.
    Eigen::VectorXd values(const Run& run, std::size_t parameter) const;
    rig::RigDescription rig(const Run& run) const;

  private:
    Eigen::VectorXd unit_values(const Run& run, std::size_t parameter) const;
    void apply(Json& rig, std::size_t parameter, const Eigen::VectorXd& values) const;
    rig::RigDescription read(const Json& rig) const;

    const StudyDescription& study_;
    std::vector<Run> runs_;
    std::vector<Eigen::MatrixXd> a_, b_;  ///< for each parameter: count x its columns, in (0, 1)
};

}  // namespace risorius::study
