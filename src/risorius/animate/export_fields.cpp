// SPDX-License-Identifier: MIT
#include "risorius/animate/export_fields.h"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "risorius/animate/detail/osim_text.h"
#include "risorius/animate/detail/ready_face.h"
#include "risorius/animate/render_inputs.h"
#include "risorius/animate/render_job.h"
#include "risorius/animate/render_session.h"
#include "risorius/core/error.h"
#include "risorius/core/json_object.h"
#include "risorius/core/json_text.h"
#include "risorius/core/known_names.h"
#include "risorius/core/toolkit_record.h"
#include "risorius/face/fields.h"
#include "risorius/io/vtk_file.h"
#include "risorius/report/atomic_file.h"
#include "risorius/report/atomic_folder.h"
#include "risorius/track/timeline.h"

namespace risorius::animate {

namespace {

/// More frames would be a mistake, such as a long script at a high rate: they take a megabyte each at least.
constexpr int kMostFrames = 10000;

io::VtkArray vector_array(const std::string& name, const Points& values) {
    return {.name = name,
            .components = static_cast<int>(values.cols()),
            .values = {values.data(), values.data() + values.size()}};
}

io::VtkArray scalar_array(const std::string& name, const Eigen::VectorXd& values) {
    return {.name = name, .values = {values.data(), values.data() + values.size()}};
}

void add_stress(const face::Tensors& stress, io::VtkMesh& mesh) {
    io::VtkArray mises{.name = "von_mises_pa", .values = {}};
    for (long t = 0; t < stress.rows(); ++t) mises.values.push_back(face::von_mises(stress.row(t)));
    mesh.cell_data.push_back({.name = "stress_pa",
                              .components = 6,
                              .values = {stress.data(), stress.data() + stress.size()}});
    mesh.cell_data.push_back(std::move(mises));
}

void add_state(const std::vector<face::FibreState>& state, io::VtkMesh& mesh) {
    io::VtkArray direction{.name = "direction", .components = 3, .values = {}},
        stretch{.name = "stretch", .values = {}}, tension{.name = "tension_n", .values = {}},
        activation{.name = "activation", .values = {}}, column{.name = "column", .values = {}};
    for (const face::FibreState& one : state) {
        for (int k = 0; k < 3; ++k) direction.values.push_back(one.direction[k]);
        stretch.values.push_back(one.stretch);
        tension.values.push_back(one.tension_n);
        activation.values.push_back(one.activation);
        column.values.push_back(one.column);
    }
    for (io::VtkArray* array : {&direction, &stretch, &tension, &activation, &column})
        mesh.cell_data.push_back(std::move(*array));
}

io::VtkMesh moved_mesh(const Points& rest, const Points& nodes) {
    io::VtkMesh mesh;
    mesh.points = nodes;
    mesh.point_data.push_back(vector_array("displacement_m", Points(nodes - rest)));
    return mesh;
}

io::VtkMesh tissue_mesh(const face::TissueFields& fields) {
    io::VtkMesh mesh = moved_mesh(fields.rest, fields.nodes);
    mesh.point_data.push_back(scalar_array("contact_pa", fields.contact_pa));
    for (long t = 0; t < fields.tets.rows(); ++t)
        mesh.add_cell(io::VtkCell::kTetra, {fields.tets.row(t).data(), 4});
    mesh.cell_data.push_back(scalar_array("J", fields.volume_ratio));
    add_stress(fields.stress_pa, mesh);
    mesh.cell_data.push_back(
        {.name = "superficial", .values = {fields.superficial.begin(), fields.superficial.end()}});
    return mesh;
}

io::VtkMesh fibre_mesh(const face::FibreFields& fields) {
    io::VtkMesh mesh = moved_mesh(fields.rest, fields.nodes);
    for (const std::array<int, 2>& segment : fields.segments)
        mesh.add_cell(io::VtkCell::kLine, segment);
    add_state(fields.state, mesh);
    return mesh;
}

io::VtkMesh solid_mesh(const face::SolidFields& fields) {
    io::VtkMesh mesh = moved_mesh(fields.rest, fields.nodes);
    for (long c = 0; c < fields.cells.rows(); ++c) {
        const int* corner = fields.cells.row(c).data();
        if (corner[2] != corner[3]) {
            mesh.add_cell(io::VtkCell::kHexahedron, {corner, 8});
        } else {
            const std::array<int, 4> tet{corner[0], corner[1], corner[2], corner[4]};
            mesh.add_cell(io::VtkCell::kTetra, tet);
        }
    }
    mesh.cell_data.push_back(scalar_array("J", fields.volume_ratio));
    add_stress(fields.stress_pa, mesh);
    add_state(fields.state, mesh);
    return mesh;
}

/// The outer skin with only the vertices that it has.
class Skin {
  public:
    explicit Skin(const rig::Head& head) {
        std::vector<int> place(static_cast<std::size_t>(head.vertices.rows()), -1);
        for (long f = 0; f < head.skin.rows(); ++f) {
            std::array<int, 3> triangle{};
            for (int k = 0; k < 3; ++k) {
                int& at = place[static_cast<std::size_t>(head.skin(f, k))];
                if (at < 0) {
                    at = static_cast<int>(vertex_.size());
                    vertex_.push_back(head.skin(f, k));
                }
                triangle[static_cast<std::size_t>(k)] = at;
            }
            triangles_.push_back(triangle);
        }
        rest_ = head.vertices(vertex_, Eigen::all);
    }

    io::VtkMesh mesh(const Points& vertices) const {
        io::VtkMesh out = moved_mesh(rest_, vertices(vertex_, Eigen::all));
        for (const auto& triangle : triangles_) out.add_cell(io::VtkCell::kTriangle, triangle);
        return out;
    }

  private:
    std::vector<int> vertex_;
    std::vector<std::array<int, 3>> triangles_;
    Points rest_;
};

/// Writes the files of one folder, and keeps the series.
class SeriesWriter {
  public:
    SeriesWriter(const std::filesystem::path& folder, io::VtkEncoding encoding)
        : folder_(folder), encoding_(encoding) {}

    void write(const std::string& name, int frame, double time_s, const io::VtkMesh& mesh) {
        const bool surface = name == "skin";
        char number[16];
        std::snprintf(number, sizeof number, "_%04d", frame);
        const std::string file = name + number + (surface ? ".vtp" : ".vtu");
        report::write_text(folder_ / file, surface ? io::vtp_bytes(mesh, encoding_, time_s)
                                                   : io::vtu_bytes(mesh, encoding_, time_s));
        files_.push_back(file);
        const auto known = std::find(names_.begin(), names_.end(), name);
        const int part = static_cast<int>(known - names_.begin());
        if (known == names_.end()) {
            names_.push_back(name);
            series_.emplace_back();
            Json arrays = Json::object();
            for (const auto* data : {&mesh.point_data, &mesh.cell_data})
                for (const io::VtkArray& array : *data) arrays[array.name] = array.components;
            meshes_[name] = json_object(
                {{"points", mesh.points.rows()}, {"cells", mesh.cells()}, {"arrays", arrays}});
        }
        const io::VtkStep step{.time_s = time_s, .part = 0, .file = file};
        series_[static_cast<std::size_t>(part)].push_back(step);
        all_.push_back(step);
        all_.back().part = part;
    }

    void finish() {
        for (std::size_t i = 0; i < names_.size(); ++i) add(names_[i], series_[i]);
        add("face", all_);
    }

    const Json& meshes() const { return meshes_; }
    const std::vector<std::string>& files() const { return files_; }

  private:
    void add(const std::string& name, const std::vector<io::VtkStep>& steps) {
        files_.push_back(name + ".pvd");
        report::write_text(folder_ / files_.back(), io::pvd_bytes(steps));
    }

    std::filesystem::path folder_;
    io::VtkEncoding encoding_;
    std::vector<std::string> names_, files_;
    std::vector<std::vector<io::VtkStep>> series_;
    std::vector<io::VtkStep> all_;
    Json meshes_ = Json::object();
};

/// The plan of a render at the times of the export.
RenderJob export_plan(const ExportOptions& options, RenderInputs& inputs) {
    RenderRequest request;
    request.script = options.script;
    request.rig = options.rig;
    request.quality = options.quality;
    request.fps = options.fps;
    request.times_s = options.times_s;
    request.out = options.out / "frame.png";  // no picture is made
    if (request.times_s.empty()) {
        const track::ScriptHeader header =
            track::read_script_header(inputs.script(options.script)->json);
        const int fps = std::clamp(options.fps.value_or(header.fps), 1, 240);
        const int frames = track::frame_count(header.duration_s, fps);
        if (frames > kMostFrames)
            throw Error(option_name("fps"),
                        "at most " + std::to_string(kMostFrames) + " frames of " +
                            format_number(header.duration_s) + " s",
                        std::to_string(frames));
        for (int frame = 0; frame < frames; ++frame)
            request.times_s.push_back(static_cast<double>(frame) / fps);
    }
    const auto early = std::is_sorted_until(request.times_s.begin(), request.times_s.end());
    if (early != request.times_s.end())
        throw Error(option_name("times_s"), "ascending times",
                    format_number(*early) + " after " + format_number(*(early - 1)));
    return plan_render_job(request, inputs);
}

/// The fields of all frames as files of VTK. Adds what they are to the record.
std::vector<std::string> write_fields(const ExportOptions& options, const RenderJob& job,
                                      face::Face& face, const face::DriveAt& drive,
                                      const std::filesystem::path& folder,
                                      const ProgressMonitor& monitor, Json& record) {
    const io::VtkEncoding encoding =
        options.encoding == "ascii" ? io::VtkEncoding::kAscii : io::VtkEncoding::kAppended;
    const Skin skin(face.head());
    SeriesWriter series(folder, encoding);
    for (int frame = 0; frame < job.frames; ++frame) {
        monitor.throw_if_stopped();
        const double time_s = job.time_s(frame);
        const face::FacePose pose = face.pose_at(time_s, drive);
        const face::FaceFields fields = face.fields().at(time_s);
        series.write("tissue", frame, time_s, tissue_mesh(fields.tissue));
        series.write("fibres", frame, time_s, fibre_mesh(fields.fibres));
        if (fields.solids.cells.rows() > 0)
            series.write("solids", frame, time_s, solid_mesh(fields.solids));
        series.write("skin", frame, time_s, skin.mesh(pose.vertices));
        monitor.report((frame + 1.0) / job.frames, "frame");
    }
    series.finish();
    record["meshes"] = series.meshes();
    return series.files();
}

/// The muscles as a model of OpenSim, and their activations over time. Adds what they are to the record.
std::vector<std::string> write_osim(const RenderJob& job, face::Face& face,
                                    const face::DriveAt& drive, const std::filesystem::path& folder,
                                    const ProgressMonitor& monitor, Json& record) {
    const std::vector<face::MuscleLine> lines = face.fields().muscle_lines();
    const std::vector<std::string> names = osim_names(lines),
                                   columns = job.rig->files.rig.channels().column_names();
    report::write_text(folder / "face.osim",
                       osim_text(job.rig->files.rig.name, lines, face.fields().jaw_hinge()));
    std::vector<double> times_s;
    std::vector<std::vector<double>> rows;
    for (int frame = 0; frame < job.frames; ++frame) {
        monitor.throw_if_stopped();
        times_s.push_back(job.time_s(frame));
        face.pose_at(times_s.back(), drive);
        const Eigen::VectorXd activation = face.activation_at(times_s.back());
        rows.emplace_back();
        for (const face::MuscleLine& line : lines) rows.back().push_back(activation[line.column]);
        monitor.report((frame + 1.0) / job.frames, "frame");
    }
    report::write_text(folder / "activation.sto", storage_text("activation", names, times_s, rows));
    record["muscles"] = Json::object();
    for (std::size_t i = 0; i < lines.size(); ++i)
        record["muscles"][names[i]] =
            json_object({{"column", columns[static_cast<std::size_t>(lines[i].column)]},
                         {"points", lines[i].path.size()},
                         {"f0_n", lines[i].f0_n},
                         {"optimal_m", lines[i].optimal_m},
                         {"slack_m", lines[i].slack_m}});
    return {"face.osim", "activation.sto"};
}

}  // namespace

Json export_fields(const ExportOptions& options, const ProgressMonitor& monitor) {
    index_of_name(option_name("encoding"), options.encoding, {"ascii", "appended"});
    const bool fields = index_of_name(option_name("format"), options.format, {"vtu", "osim"}) == 0;
    RenderInputs inputs(monitor);
    const RenderJob job = export_plan(options, inputs);
    report::AtomicFolder staged(options.out);

    RenderSession session;
    face::Face& face = ready_face(job, session);
    const track::ChannelTable channels = job.rig->files.rig.channels();
    const track::Timeline timeline(job.script, channels);
    const face::DriveAt drive = [&](double t_s) { return timeline.at(t_s); };
    face.start(drive);

    Json record = Json::object();
    record["format"] = "risorius-export";
    record["version"] = 1;
    record["toolkit"] = toolkit_record();
    record["script"] = job.script_file.path.generic_string();
    record["rig"] = job.rig->rig.path.generic_string();
    record["quality"] = job.quality.name;
    if (fields) record["encoding"] = options.encoding;
    record["frames"] = job.frames;
    record["times_s"] = Json::array();
    for (int frame = 0; frame < job.frames; ++frame) record["times_s"].push_back(job.time_s(frame));
    std::vector<std::string> files =
        fields ? write_fields(options, job, face, drive, staged.partial(), monitor, record)
               : write_osim(job, face, drive, staged.partial(), monitor, record);
    record["columns"] = channels.column_names();
    files.push_back("results.json");
    std::sort(files.begin(), files.end());
    record[report::kFilesKey] = files;
    report::write_text(staged.partial() / "results.json", json_text(record, 2) + "\n");
    staged.commit();
    return record;
}

}  // namespace risorius::animate
