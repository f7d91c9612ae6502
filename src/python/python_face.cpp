// SPDX-License-Identifier: MIT
#include "python/python_face.h"

#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "python/python_fields.h"
#include "python/python_values.h"
#include "risorius/core/data_folder.h"
#include "risorius/core/error.h"
#include "risorius/face/diagnostics.h"
#include "risorius/face/face.h"
#include "risorius/face/statics.h"
#include "risorius/face/surfaces.h"
#include "risorius/render/offscreen_view.h"
#include "risorius/rig/expression_drive.h"
#include "risorius/scene/rig_files.h"
#include "risorius/scene/scene_from_rig.h"
#include "risorius/track/script.h"
#include "risorius/track/timeline.h"

namespace py = pybind11;

namespace risorius::python {

namespace {

using Values = std::map<std::string, double>;

class PythonFace {
  public:
    PythonFace(const std::filesystem::path& rig, const std::string& quality)
        : files_(scene::read_rig_files(rig)),
          face_(files_.rig, files_.mesh, face::quality_named(quality), files_.place()),
          channels_(files_.rig.channels()) {
        drive_.excitation = Eigen::VectorXd::Zero(channels_.column_count());
        reset();
    }

    void reset() {
        const track::Drive rest = drive_of({});
        face_.start([&](double) { return rest; });
        moved();
    }
    /// Keeps the drive for the steps that follow.
    void set(const Values& values) { drive_ = drive_of(values); }
    bool solve_equilibrium(const std::optional<Values>& values) {
        if (values) set(*values);
        const bool converged = face_.solve_equilibrium(drive_.excitation, drive_).converged;
        moved();
        return converged;
    }
    void step(const std::optional<Values>& values, int steps) {
        if (steps < 1) throw Error("steps", "1 or more", std::to_string(steps));
        if (values) set(*values);
        for (int i = 0; i < steps; ++i) face_.step([&](double) { return drive_; });
        moved();
    }

    std::vector<Points> sensitivities(const std::vector<std::string>& names) {
        std::vector<int> columns;
        std::vector<track::Kinematic> kinematic;
        // The library returns columns first; the order of the caller is kept.
        std::vector<std::pair<bool, std::size_t>> place;
        for (const std::string& name : names) {
            const std::vector<track::Kinematic> found = track::kinematic_named(name);
            if (found.size() == 1) {
                place.emplace_back(false, kinematic.size());
                kinematic.push_back(found[0]);
                continue;
            }
            const auto at = std::find(columns_.begin(), columns_.end(), name);
            if (at == columns_.end())
                throw Error("sensitivities", "a name of Face.columns or a single channel",
                            "\"" + name + "\"");
            place.emplace_back(true, columns.size());
            columns.push_back(static_cast<int>(at - columns_.begin()));
        }
        const std::vector<Points> all = face_.statics().sensitivities(columns, kinematic);
        std::vector<Points> out;
        for (const auto& [is_column, i] : place)
            out.push_back(all[is_column ? i : columns.size() + i]);
        return out;
    }

    Image draw(int width, int height, const std::string& camera, bool draft) {
        const render::ViewOptions wanted{
            .width_px = width, .height_px = height, .camera = camera, .draft = draft};
        if (!view_ || !(wanted == options_)) {
            if (!scene_) {
                scene_ = scene::scene_from_rig(face_.head(), files_.rig, files_.mesh);
                scene::add_wrinkles(face_.surfaces().wrinkle_lines(), *scene_);
            }
            view_ = std::make_unique<render::OffscreenView>(*scene_, wanted);
            options_ = wanted;
        }
        return view_->draw(scene::pose_for_view(pose()));
    }

    track::Drive drive_of(const Values& values) const {
        track::Expansion sum = track::Expansion::none(channels_);
        for (const auto& [name, value] : values) add(name, value, sum);
        return rig::clamped_drive(sum, channels_);
    }

    /// Plays a script: calls `see` with the time of each frame.
    void play(const JsonCursor& json, std::optional<int> fps, const py::function& see) {
        const track::ScriptDescription script =
            track::read_script(json, channels_, files_.rig.facs, files_.rig.expressions);
        const track::Timeline timeline(script, channels_);
        const face::DriveAt drive = [&](double t_s) { return timeline.at(t_s); };
        const int rate = fps.value_or(script.header.fps);
        if (rate < 1 || rate > 240) throw Error("fps", "1 to 240", std::to_string(rate));
        const int frames = std::max(1, static_cast<int>(script.header.duration_s * rate + 0.5));
        face_.start(drive);
        for (int f = 0; f < frames; ++f) {
            const double t_s = static_cast<double>(f) / rate;
            {
                const py::gil_scoped_release free;
                keep(face_.pose_at(t_s, drive));
            }
            if (PyErr_CheckSignals() != 0) throw py::error_already_set();
            see(t_s);
        }
    }

    const track::Drive& drive() const { return drive_; }
    const scene::RigFiles& files() const { return files_; }
    face::Face& face() { return face_; }
    const track::ChannelTable& channels() const { return channels_; }
    Eigen::Index vertex_count() { return face_.head().vertices.rows(); }
    const Points& vertices() {
        pose();
        return vertices_;
    }
    /// While somebody keeps what this returns, every step brings the vertices up to date.
    std::shared_ptr<const char> watch() {
        std::shared_ptr<const char> watcher = watcher_.lock();
        if (!watcher) watcher_ = watcher = std::make_shared<const char>('\0');
        return watcher;
    }
    const std::vector<std::string>& columns() const { return columns_; }

  private:
    // The memory of the vertices stays where it is, so that arrays that look at it stay valid.
    void keep(face::FacePose pose) {
        pose_ = std::move(pose);
        vertices_ = pose_.vertices;
        is_posed_ = true;
    }
    // A pose takes half the time of a step, so it is made when somebody looks.
    void moved() {
        is_posed_ = false;
        if (!watcher_.expired()) pose();
    }
    const face::FacePose& pose() {
        if (!is_posed_) keep(face_.pose());
        return pose_;
    }

    void add(const std::string& name, double value, track::Expansion& sum) const {
        if (!std::isfinite(value)) throw Error(name, "a number", "NaN or infinity");
        if (const std::optional<track::Expansion> found =
                rig::expansion_at(files_.rig, name, value)) {
            sum.add(*found, 1.0);
            return;
        }
        const track::SidedName sided = track::split_side(name);
        if (sided.side && (files_.rig.facs.find(sided.id) || channels_.find(sided.id)))
            throw Error(name, "\"" + sided.id + "\", which has no sides", "\"" + name + "\"");
        throw Error(
            files_.place(),
            "the name of a muscle, an action unit, an expression, a blend shape or a channel",
            "\"" + name + "\"");
    }

    std::vector<std::string> column_names() const {
        std::vector<std::string> names(static_cast<std::size_t>(channels_.column_count()));
        for (const track::MuscleChannel& muscle : channels_.muscles)
            for (const Side side : {Side::kLeft, Side::kRight})
                names[static_cast<std::size_t>(channels_.column(muscle.id, side))] =
                    muscle.paired ? muscle.id + (side == Side::kLeft ? ".l" : ".r") : muscle.id;
        return names;
    }

    scene::RigFiles files_;
    face::Face face_;
    track::ChannelTable channels_;
    std::vector<std::string> columns_ = column_names();
    track::Drive drive_;
    face::FacePose pose_;
    Points vertices_;
    bool is_posed_ = false;
    std::weak_ptr<const char> watcher_;
    std::optional<render::Scene> scene_;
    render::ViewOptions options_{};
    std::unique_ptr<render::OffscreenView> view_;
};

Side side_named(const std::string& name) {
    if (name != "l" && name != "r") throw Error("side", "\"l\" or \"r\"", "\"" + name + "\"");
    return name == "l" ? Side::kLeft : Side::kRight;
}

py::dict muscle_dict(PythonFace& self, const std::string& muscle, const std::string& side) {
    const auto state = self.face().diagnostics().muscle_state(muscle, side_named(side));
    if (!state)
        throw Error(muscle, "a muscle that the face simulates", "one that it does not simulate");
    py::dict out;
    out["length_m"] = state->length_m;
    out["stretch"] = state->stretch;
    out["force_n"] = state->force_n;
    out["stress_pa"] = state->stress_pa ? py::cast(*state->stress_pa) : py::none();
    return out;
}

Eigen::VectorXd rig_gradient_of(PythonFace& self, const Points& vertex_gradient,
                                const std::vector<std::string>& paths) {
    if (vertex_gradient.rows() != self.vertex_count())
        throw Error("vertex_gradient", std::to_string(self.vertex_count()) + " rows",
                    std::to_string(vertex_gradient.rows()));
    const py::gil_scoped_release free;
    return rig_gradient(self.face(), self.files().file, self.drive(), vertex_gradient, paths);
}

py::array picture(PythonFace& self, int width, int height, const std::string& camera, bool draft) {
    Image image;
    {
        const py::gil_scoped_release free;
        image = self.draw(width, height, camera, draft);
    }
    return py::array_t<std::uint8_t>({image.height_px, image.width_px, 4}, image.rgba.data());
}

py::array sensitivity_array(PythonFace& self, const std::vector<std::string>& names) {
    std::vector<Points> all;
    {
        const py::gil_scoped_release free;
        all = self.sensitivities(names);
    }
    const py::ssize_t rows = self.vertex_count();
    py::array_t<double> out({static_cast<py::ssize_t>(all.size()), rows, py::ssize_t{3}});
    for (std::size_t i = 0; i < all.size(); ++i)
        std::copy(all[i].data(), all[i].data() + all[i].size(),
                  out.mutable_data(static_cast<py::ssize_t>(i), 0, 0));
    return out;
}

// Names of what a face can be driven by.
void add_names(py::class_<PythonFace>& face) {
    face.def_property_readonly(
            "columns", &PythonFace::columns,
            "Names of the columns of activation: muscles, with .l and .r where they are paired.")
        .def_property_readonly(
            "muscles",
            [](const PythonFace& self) {
                std::vector<std::string> names;
                for (const auto& muscle : self.channels().muscles) names.push_back(muscle.id);
                return names;
            },
            "Names of the muscles.")
        .def_property_readonly(
            "units",
            [](const PythonFace& self) {
                std::vector<std::string> names;
                for (const auto& unit : self.files().rig.facs.units)
                    if (unit.unsupported.empty()) names.push_back(unit.id);
                return names;
            },
            "Names of the action units that the face can show.")
        .def_property_readonly(
            "expressions",
            [](const PythonFace& self) {
                std::vector<std::string> names;
                for (const auto& one : self.files().rig.expressions.list) names.push_back(one.name);
                return names;
            },
            "Names of the expressions.")
        .def_property_readonly(
            "channels",
            [](const PythonFace&) {
                std::vector<std::string> names;
                for (const auto& channel : track::kinematic_channels())
                    names.emplace_back(channel.name);
                return names;
            },
            "Names of the kinematic channels of jaw, gaze, head, mouth pressure and tongue.")
        .def_property_readonly(
            "landmarks",
            [](const PythonFace& self) {
                std::vector<std::string> names;
                for (const auto& [id, place] :
                     const_cast<PythonFace&>(self).face().head().landmarks)
                    names.push_back(id);
                return names;
            },
            "Names of the landmarks.");
}

/// What an array of the vertices refers to: its face, which brings it up to date as long as there is such an array.
py::capsule watched(const py::object& self) {
    struct Watched {
        py::object face;
        std::shared_ptr<const char> watcher;
    };
    return {new Watched{self, self.cast<PythonFace&>().watch()},
            [](void* of) { delete static_cast<Watched*>(of); }};
}

// Numbers of the face. Arrays look at its memory unless their text says that they are copies.
void add_arrays(py::class_<PythonFace>& face) {
    const auto points = [](const Points& of, const py::object& owner) {
        return view_of(of.data(), of.rows(), 3, owner);
    };
    face.def_property_readonly(
            "vertices",
            [points](const py::object& self) {
                return points(self.cast<PythonFace&>().vertices(), watched(self));
            },
            "Vertices of the mesh, V x 3, m, world frame. The next step or equilibrium overwrites "
            "the array.")
        .def_property_readonly(
            "rest_vertices",
            [points](const py::object& self) {
                return points(self.cast<PythonFace&>().face().head().vertices, self);
            },
            "Vertices of the mesh at rest, V x 3, m, head frame.")
        .def_property_readonly(
            "triangles",
            [](const py::object& self) {
                const Triangles& skin = self.cast<PythonFace&>().face().surfaces().simulated_skin();
                return view_of(skin.data(), skin.rows(), 3, self);
            },
            "Triangles of the simulated skin, F x 3 indices of vertices.")
        .def_property_readonly(
            "nodes",
            [points](const py::object& self) {
                return points(self.cast<PythonFace&>().face().statics().nodes(), self);
            },
            "Nodes of the tissue, then those of the volume muscles, N x 3, m, head frame. The next "
            "step or equilibrium "
            "overwrites the array.")
        .def_property_readonly(
            "tets",
            [](const py::object& self) {
                const Tets& tets = self.cast<PythonFace&>().face().diagnostics().tets();
                return view_of(tets.data(), tets.rows(), 4, self);
            },
            "Tetrahedra of the tissue, T x 4 indices of nodes.")
        .def_property_readonly(
            "activation",
            [](const py::object& self) {
                const Eigen::VectorXd& a = self.cast<PythonFace&>().face().activation();
                py::array_t<double> out({a.size()}, a.data(), self);
                out.attr("flags").attr("writeable") = false;
                return out;
            },
            "Activation of each column, 0 to 1. The next step or equilibrium overwrites the array.")
        .def_property_readonly(
            "time_s", [](PythonFace& self) { return self.face().time_s(); },
            "Time since the last reset or play, s.")
        .def_property_readonly(
            "step_s", [](PythonFace& self) { return self.face().step_s(); }, "Length of a step, s.")
        .def_property_readonly(
            "energy_j", [](PythonFace& self) { return self.face().diagnostics().energy_j(); },
            "Potential energy, J.")
        .def(
            "landmark",
            [](PythonFace& self, const std::string& id) {
                return Vec3(self.face().diagnostics().landmark(id));
            },
            py::arg("id"), "Position of a landmark, m, world frame.")
        .def(
            "fields", [](PythonFace& self) { return fields_dict(self.face()); },
            "The fields that `risorius export --format vtu` writes, after the last step or "
            "equilibrium: a dict of \"tissue\", \"fibres\" and \"solids\", each a dict of arrays, "
            "which are copies. N nodes, C cells, m, world frame: rest and nodes, N x 3; cells, C x "
            "corners; J, C, volume ratio; stress_pa, C x 6 (xx, yy, zz, xy, yz, xz), and "
            "von_mises_pa, C; contact_pa, N. Of fibres and solids: column, direction (C x 3), "
            "activation, stretch (fibre length over optimal length) and tension_n, C.")
        .def("muscle", &muscle_dict, py::arg("muscle"), py::arg("side"),
             "length_m, stretch, force_n and stress_pa of one side, \"l\" or \"r\", of a muscle. "
             "The force is isometric: that of this "
             "length and activation, without the effect of velocity.");
}

}  // namespace

void add_face(py::module_& module) {
    py::class_<PythonFace> face(
        module, "Face",
        "A face with muscles under its skin.\n\n"
        "rig: the path of a rig; default: the adult that comes with Risorius\n"
        "quality: draft, preview, video or fine\n\n"
        "Drives are dicts from names to values: muscles (0 to 1, \"zygomaticus_major\" or "
        "\"zygomaticus_major.l\"), action "
        "units (\"AU12\", \"AU12.r\"), expressions (\"happiness\"), blend shapes "
        "(\"mouthSmileLeft\") and channels (\"jaw_open\", "
        "\"gaze_yaw_deg\"). Their effects are added.");
    face.def(
        py::init([](const std::optional<std::filesystem::path>& rig, const std::string& quality) {
            const std::filesystem::path file = rig ? *rig : data_folder() / "rigs/adult/rig.json";
            const py::gil_scoped_release free;
            return std::make_unique<PythonFace>(file, quality);
        }),
        py::arg("rig") = py::none(), py::arg("quality") = "preview");
    const py::call_guard<py::gil_scoped_release> free;
    face.def("reset", &PythonFace::reset, free, "Sets the time to 0 and lets the face rest.")
        .def("set", &PythonFace::set, py::arg("drive"), free,
             "Sets what drives the steps that follow.")
        .def("solve_equilibrium", &PythonFace::solve_equilibrium, py::arg("drive") = py::none(),
             free,
             "Puts the face into equilibrium with the drive, and returns whether the solver came "
             "to rest.")
        .def("settle", &PythonFace::solve_equilibrium, py::arg("drive") = py::none(), free,
             "The former name of solve_equilibrium().")
        .def("step", &PythonFace::step, py::arg("drive") = py::none(), py::arg("steps") = 1, free,
             "Advances by steps of step_s, with the dynamics of muscles and tissue.")
        .def("sensitivities", &sensitivity_array, py::arg("names"),
             "Derivatives of the vertices, K x V x 3: m per unit of activation of a column, or per "
             "unit of a channel. Call "
             "solve_equilibrium() before.")
        .def(
            "rig_gradient", &rig_gradient_of, py::arg("vertex_gradient"), py::arg("paths"),
            "Derivatives of a function L of the vertices by numbers of the rig, one for each path: "
            "dL per relative change of all numbers of the path.\n\n"
            "vertex_gradient: dL/d(vertices), V x 3, in the equilibrium of the last "
            "solve_equilibrium()\n"
            "paths: as in a study, of \"tissue/\", \"skin/\", \"anatomy/strength/\" and strength "
            "and "
            "moduli of \"anatomy/solids/\": "
            "\"tissue/deep_shear_pa\", \"anatomy/strength/risorius\"")
        .def(
            "play",
            [](PythonFace& self, const py::object& script, const py::function& see,
               std::optional<int> fps) {
                if (py::isinstance<py::dict>(script))
                    self.play(JsonCursor::from_json(json_of(script), "script"), fps, see);
                else
                    self.play(JsonCursor::read_file(script.cast<std::filesystem::path>()), fps,
                              see);
            },
            py::arg("script"), py::arg("see"), py::arg("fps") = py::none(),
            "Plays a script, a path or a dict, and calls see(t_s) at each frame.")
        .def("render", &picture, py::arg("width") = 512, py::arg("height") = 512,
             py::arg("camera") = "front", py::arg("draft") = false,
             "Draws the face: height x width x 4, RGBA, 8 bits, sRGB.");
    add_names(face);
    add_arrays(face);
}

}  // namespace risorius::python
