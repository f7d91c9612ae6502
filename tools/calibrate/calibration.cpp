// SPDX-License-Identifier: MIT
#include "tools/calibrate/calibration.h"

#include <cmath>
#include <cstdio>
#include <memory>

#include "risorius/face/anatomy/tissue_mesh.h"
#include "risorius/face/calibration.h"
#include "risorius/face/diagnostics.h"
#include "risorius/face/face.h"
#include "risorius/face/statics.h"
#include "risorius/face/surfaces.h"
#include "risorius/scene/expression_score.h"
#include "risorius/solve/box_quadratic.h"

namespace risorius::calibrate {

namespace {

// An expression: the target at the skin nodes, and its activations among the unknowns.
struct Expression {
    const inverse::MeasuredShape* shape;
    std::vector<inverse::ActivationUnknown> unknowns;
    Eigen::VectorXd l1_weight;    // larger for muscles that the table does not list
    Eigen::VectorXd table, goal;  // goal: 3 per node, times the root of its area
    double size;                  // |goal|^2
    long first;                   // index of its first activation among all unknowns
};

struct Trial {
    std::vector<std::unique_ptr<face::Face>> faces;
    std::vector<track::Drive> drives;
    std::vector<Eigen::VectorXd> miss;
    double cost = 0;
};

// One parameter acts on few nodes only.
struct SparseForce {
    std::vector<int> row;
    std::vector<Eigen::Vector3f> value;
};

class Calibration {
  public:
    Calibration(const scene::RigFiles& files, const std::vector<inverse::MeasuredShape>& shapes,
                const std::vector<Parameter>& parameters, const Options& options)
        : files_(files), parameters_(parameters), options_(options) {
        const face::Face face = make_face(files.rig);
        const face::Shell& shell = face.diagnostics().shell();
        const Eigen::VectorXd fine =
            scene::vertex_areas(face.surfaces().simulated_skin(), face.head().vertices);
        root_area_ = Eigen::VectorXd::Zero(static_cast<long>(shell.vertex.size()));
        for (long v = 0; v < fine.size(); ++v)
            if (fine[v] > 0) root_area_[shell.collapsed_to[static_cast<std::size_t>(v)]] += fine[v];
        root_area_ = root_area_.cwiseSqrt();
        long unknowns = static_cast<long>(parameters.size());
        for (const inverse::MeasuredShape& shape : shapes) {
            Expression one;
            one.shape = &shape;
            one.unknowns = inverse::activation_unknowns(files.rig, shape.drive, shape.sided);
            one.table.resize(static_cast<long>(one.unknowns.size()));
            for (std::size_t i = 0; i < one.unknowns.size(); ++i)
                one.table[static_cast<long>(i)] = inverse::value_of(one.unknowns[i], shape.drive);
            // The tables fix the lids, and the jaw unless the table moves it: only the face around them is to be fitted.
            for (inverse::ActivationUnknown& unknown : one.unknowns)
                if (unknown.name.starts_with("levator_palpebrae") ||
                    unknown.name.starts_with("superior_tarsal") ||
                    (!unknown.channels.empty() && inverse::value_of(unknown, shape.drive) == 0))
                    unknown.min = unknown.max = inverse::value_of(unknown, shape.drive);
            one.l1_weight = one.table.unaryExpr(
                [&](double value) { return options.l1_weight * (value != 0 ? 0.5 : 5.0); });
            for (std::size_t i = 0; i < one.unknowns.size(); ++i)
                if (!one.unknowns[i].channels.empty()) one.l1_weight[static_cast<long>(i)] *= 2;
            Points measured(static_cast<long>(shell.vertex.size()), 3);
            for (std::size_t v = 0; v < shell.vertex.size(); ++v)
                measured.row(static_cast<long>(v)) = shape.displacement.row(shell.vertex[v]);
            one.goal = weighted(measured);
            one.size = one.goal.squaredNorm();
            one.first = unknowns;
            unknowns += one.table.size();
            expressions_.push_back(std::move(one));
        }
        z_ = Eigen::VectorXd::Zero(unknowns);
        for (const Expression& one : expressions_)
            z_.segment(one.first, one.table.size()) = one.table;
    }

    Result run(const std::function<void(const std::string&)>& report) {
        Trial now = attempt(z_);
        Result result;
        for (std::size_t e = 0; e < expressions_.size(); ++e)
            result.relative_before.push_back(relative(now, e));
        say(report, "begins", now);
        double reach = 1;
        for (int round = 0; round < options_.rounds && reach > 0.05; ++round) {
            solve::BoxQuadratic problem = linearised(now, report);
            bool better = false;
            while (!better && reach > 0.05) {
                limit(reach, problem);
                Eigen::VectorXd next = z_;
                solve::minimise(problem, next, 1e-6, 400);
                Trial trial = attempt(next);
                say(report, "reach " + std::to_string(reach), trial);
                better = trial.cost < now.cost;
                if (better) {
                    z_ = next;
                    now = std::move(trial);
                    reach = std::min(1.0, 1.5 * reach);
                } else {
                    reach *= 0.4;
                }
            }
        }
        result.parameters = z_.head(static_cast<long>(parameters_.size()));
        for (std::size_t e = 0; e < expressions_.size(); ++e) {
            const Expression& one = expressions_[e];
            result.activations.push_back(z_.segment(one.first, one.table.size()));
            result.unknowns.push_back(one.unknowns);
            result.relative_after.push_back(relative(now, e));
        }
        return result;
    }

  private:
    face::Face make_face(const rig::RigDescription& rig) const {
        return face::Face(rig, files_.mesh, face::quality_named(options_.quality), files_.place());
    }
    Eigen::VectorXd weighted(const Points& nodes) const {
        Eigen::VectorXd out(3 * nodes.rows());
        for (long v = 0; v < nodes.rows(); ++v)
            out.segment<3>(3 * v) = root_area_[v] * nodes.row(v).transpose();
        return out;
    }
    double relative(const Trial& trial, std::size_t e) const {
        return std::sqrt(trial.miss[e].squaredNorm() / expressions_[e].size);
    }
    track::Drive drive_of(const Expression& one, const Eigen::VectorXd& z) const {
        track::Drive drive = one.shape->drive;
        for (std::size_t i = 0; i < one.unknowns.size(); ++i)
            inverse::set_value(one.unknowns[i], z[one.first + static_cast<long>(i)], drive);
        return drive;
    }

    Trial attempt(const Eigen::VectorXd& z) const {
        Trial out;
        const rig::RigDescription rig =
            changed(files_.rig, parameters_, z.head(static_cast<long>(parameters_.size())));
        for (const Expression& one : expressions_) {
            out.drives.push_back(drive_of(one, z));
            out.faces.push_back(std::make_unique<face::Face>(make_face(rig)));
            face::Face& face = *out.faces.back();
            face.solve_equilibrium(out.drives.back().excitation, out.drives.back());
            out.miss.push_back(
                weighted(face.diagnostics().skin_nodes() - face.diagnostics().rest_skin_nodes()) -
                one.goal);
            out.cost += 0.5 * out.miss.back().squaredNorm() / one.size;
            const Eigen::VectorXd a = z.segment(one.first, one.table.size());
            out.cost += one.l1_weight.dot(a.cwiseAbs()) +
                        0.5 * options_.stay * (a - one.table).squaredNorm();
        }
        for (std::size_t p = 0; p < parameters_.size(); ++p) {
            const double off = z[static_cast<long>(p)] / parameters_[p].spread;
            out.cost += 0.5 * options_.keep * off * off;
        }
        return out;
    }

    static SparseForce difference(const Points& more, const Points& less, double span) {
        SparseForce out;
        for (long i = 0; i < more.rows(); ++i) {
            const Vec3 slope = (more.row(i) - less.row(i)).transpose() / span;
            if (slope.isZero(0.0)) continue;
            out.row.push_back(static_cast<int>(i));
            out.value.push_back(slope.cast<float>());
        }
        return out;
    }

    // The quadratic model about the current unknowns, without limits.
    solve::BoxQuadratic linearised(const Trial& now,
                                   const std::function<void(const std::string&)>& report) const {
        const long parameters = static_cast<long>(parameters_.size());
        const Eigen::VectorXd p = z_.head(parameters);
        // The force that each parameter adds in every expression.
        std::vector<std::vector<SparseForce>> force(expressions_.size());
        for (long i = 0; i < parameters; ++i) {
            const double step = parameters_[static_cast<std::size_t>(i)].step;
            std::vector<Points> more;
            for (const double side : {+1.0, -1.0}) {
                Eigen::VectorXd at = p;
                at[i] += side * step;
                face::Variant variant(*now.faces.front(), changed(files_.rig, parameters_, at));
                for (std::size_t e = 0; e < expressions_.size(); ++e) {
                    Points gradient = variant.gradient(now.faces[e]->statics().nodes(),
                                                       now.drives[e].excitation, now.drives[e]);
                    if (side > 0)
                        more.push_back(std::move(gradient));
                    else
                        force[e].push_back(difference(more[e], gradient, 2 * step));
                }
            }
            if (i % 100 == 99) report("  " + std::to_string(i + 1) + " parameters tried");
        }
        solve::BoxQuadratic problem;
        problem.A = Eigen::MatrixXd::Zero(z_.size(), z_.size());
        problem.b = Eigen::VectorXd::Zero(z_.size());
        problem.l1_weight = Eigen::VectorXd::Zero(z_.size());
        const rig::RigDescription rig = changed(files_.rig, parameters_, p);
        for (std::size_t e = 0; e < expressions_.size(); ++e) {
            const Expression& one = expressions_[e];
            const long own = one.table.size();
            face::Face& face = *now.faces[e];
            face::Variant same(face, rig);
            const Points nodes = face.statics().nodes();
            for (long i = 0; i < own; ++i) {
                const inverse::ActivationUnknown& unknown =
                    one.unknowns[static_cast<std::size_t>(i)];
                constexpr double kStep = 1e-3;
                const auto at = [&](double change) {
                    track::Drive drive = now.drives[e];
                    inverse::set_value(unknown, z_[one.first + i] + change, drive);
                    return same.gradient(nodes, drive.excitation, drive);
                };
                force[e].push_back(difference(at(kStep), at(-kStep), 2 * kStep));
            }
            Eigen::MatrixXd J(one.goal.size(), parameters + own);
            Points b = Points::Zero(nodes.rows(), 3);
            for (long i = 0; i < J.cols(); ++i) {
                b.setZero();
                const SparseForce& change = force[e][static_cast<std::size_t>(i)];
                for (std::size_t k = 0; k < change.row.size(); ++k)
                    b.row(change.row[k]) = -change.value[k].cast<double>().transpose();
                const Points moved = face.statics().solve(b);
                Points skin(root_area_.size(), 3);
                for (long v = 0; v < skin.rows(); ++v)
                    skin.row(v) = moved.row(face::node_of(static_cast<int>(v), face::kSkin));
                J.col(i) = weighted(skin);
            }
            force[e].clear();
            Eigen::VectorXd at(parameters + own);
            at << p, z_.segment(one.first, own);
            const Eigen::MatrixXd A = J.transpose() * J / one.size;
            const Eigen::VectorXd b_local = J.transpose() * (now.miss[e] - J * at) / one.size;
            problem.A.topLeftCorner(parameters, parameters) +=
                A.topLeftCorner(parameters, parameters);
            problem.A.block(one.first, 0, own, parameters) = A.bottomLeftCorner(own, parameters);
            problem.A.block(0, one.first, parameters, own) = A.topRightCorner(parameters, own);
            problem.A.block(one.first, one.first, own, own) = A.bottomRightCorner(own, own);
            problem.b.head(parameters) += b_local.head(parameters);
            problem.b.segment(one.first, own) = b_local.tail(own) - options_.stay * one.table;
            problem.l1_weight.segment(one.first, own) = one.l1_weight;
            problem.A.diagonal().segment(one.first, own).array() += options_.stay;
        }
        for (long i = 0; i < parameters; ++i) {
            const double spread = parameters_[static_cast<std::size_t>(i)].spread;
            problem.A(i, i) += options_.keep / (spread * spread);
        }
        return problem;
    }

    void limit(double reach, solve::BoxQuadratic& problem) const {
        problem.min = z_;
        problem.max = z_;
        for (std::size_t p = 0; p < parameters_.size(); ++p) {
            const long i = static_cast<long>(p);
            const double far = reach * 0.7 * parameters_[p].spread, max = parameters_[p].max;
            problem.min[i] = std::max(-max, z_[i] - far);
            problem.max[i] = std::min(max, z_[i] + far);
        }
        for (const Expression& one : expressions_)
            for (std::size_t i = 0; i < one.unknowns.size(); ++i) {
                const long at = one.first + static_cast<long>(i);
                problem.min[at] = std::max(one.unknowns[i].min, z_[at] - 0.3 * reach);
                problem.max[at] = std::min(one.unknowns[i].max, z_[at] + 0.3 * reach);
            }
    }

    void say(const std::function<void(const std::string&)>& report, const std::string& what,
             const Trial& trial) const {
        double sum = 0;
        for (std::size_t e = 0; e < expressions_.size(); ++e)
            sum += relative(trial, e) / static_cast<double>(expressions_.size());
        char line[160];
        std::snprintf(line, sizeof line, "%s: cost %.5f, mean relative error %.4f", what.c_str(),
                      trial.cost, sum);
        report(line);
    }

    const scene::RigFiles& files_;
    const std::vector<Parameter>& parameters_;
    Options options_;
    std::vector<Expression> expressions_;
    Eigen::VectorXd root_area_, z_;
};

}  // namespace

Result calibrate(const scene::RigFiles& files, const std::vector<inverse::MeasuredShape>& shapes,
                 const std::vector<Parameter>& parameters, const Options& options,
                 const std::function<void(const std::string&)>& report) {
    return Calibration(files, shapes, parameters, options).run(report);
}

}  // namespace risorius::calibrate
