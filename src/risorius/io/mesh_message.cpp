// SPDX-License-Identifier: MIT
#include "risorius/io/mesh_message.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "risorius/core/read_file.h"
#include "risorius/io/detail/mesh_limits.h"

namespace risorius::io {

namespace {

constexpr std::uint64_t kMeshMark = 0x31304853454D5352, kProblemMark = 0x31304D4C42505352;
constexpr std::uint64_t kEndMark = 0x31304D444E455352;
constexpr std::uint64_t kMostNames = 100'000, kLongestText = 4096,
                        kMostPictureBytes = 500 * kMegabyte;
constexpr std::size_t kBlock = 1 << 20;  // bytes; memory grows with what has come

class Writer {
  public:
    explicit Writer(const ByteSink& out) : out_(out) {}
    void number(std::uint64_t value) const { out_(&value, sizeof value); }
    void text(const std::string& value) const {
        const std::size_t size = std::min<std::size_t>(value.size(), kLongestText);
        number(size);
        out_(value.data(), size);
    }
    template <typename T>
    void list(const T* data, std::size_t count) const {
        out_(data, count * sizeof(T));
    }

  private:
    const ByteSink& out_;
};

class Reader {
  public:
    explicit Reader(const ByteSource& in) : in_(in) {}

    /// A number of at most `max`; anything else makes the message unsound.
    std::uint64_t number(std::uint64_t max) {
        std::uint64_t value = 0;
        sound_ = sound_ && in_(&value, sizeof value) && value <= max;
        return sound_ ? value : 0;
    }
    template <typename T>
    std::vector<T> list(std::uint64_t count) {
        std::vector<T> out;
        while (sound_ && out.size() < count) {
            const std::size_t used = out.size();
            const auto more = static_cast<std::size_t>(std::min<std::uint64_t>(
                count - used, std::max<std::size_t>(kBlock / sizeof(T), used)));
            out.resize(used + more);
            sound_ = in_(out.data() + used, more * sizeof(T));
        }
        if (!sound_) out.clear();
        return out;
    }
    std::vector<int> indices(std::uint64_t count, std::int64_t min, std::int64_t max) {
        std::vector<int> out = list<int>(count);
        require(std::all_of(out.begin(), out.end(), [&](int i) { return i >= min && i <= max; }));
        return out;
    }
    std::string text() {
        const std::vector<char> letters = list<char>(number(kLongestText));
        return {letters.begin(), letters.end()};
    }
    void require(bool condition) { sound_ = sound_ && condition; }
    bool sound() const { return sound_; }

  private:
    const ByteSource& in_;
    bool sound_ = true;
};

void read_faces(Reader& in, std::uint64_t vertices, geom::PolygonMesh& mesh) {
    const std::uint64_t corners = in.number(detail::kMostCorners), faces = in.number(corners / 3),
                        groups = in.number(kMostNames);
    for (const int size : in.indices(faces, 3, static_cast<std::int64_t>(corners))) {
        const std::int64_t end = static_cast<std::int64_t>(mesh.face_begin.back()) + size;
        in.require(end <= static_cast<std::int64_t>(corners));
        if (!in.sound()) return;
        mesh.face_begin.push_back(static_cast<int>(end));
    }
    in.require(mesh.face_begin.back() == static_cast<std::int64_t>(corners));
    mesh.corner_vertex = in.indices(corners, 0, static_cast<std::int64_t>(vertices) - 1);
    mesh.face_group = in.indices(faces, 0, static_cast<std::int64_t>(groups) - 1);
    for (std::uint64_t g = 0; in.sound() && g < groups; ++g) mesh.group_names.push_back(in.text());
    if (in.number(1) == 1) {
        const std::vector<double> numbers = in.list<double>(2 * corners);
        mesh.corner_texcoord.setZero(static_cast<long>(numbers.size() / 2), 2);
        for (std::size_t i = 0; i < numbers.size(); ++i)
            if (std::isfinite(numbers[i]))
                mesh.corner_texcoord(static_cast<long>(i / 2), static_cast<long>(i % 2)) =
                    numbers[i];
    }
}

void read_textures(Reader& in, geom::PolygonMesh& mesh) {
    const std::uint64_t textures = in.number(kMostNames);
    std::uint64_t left = kMostPictureBytes;
    for (std::uint64_t t = 0; in.sound() && t < textures; ++t) {
        geom::Texture texture;
        texture.file = in.text();
        texture.named_in = in.text();
        const std::uint64_t size = in.number(left);
        texture.embedded = in.list<std::uint8_t>(size);
        left -= size;
        mesh.textures.push_back(std::move(texture));
    }
    if (textures > 0)
        mesh.face_texture = in.indices(static_cast<std::uint64_t>(mesh.face_count()), -1,
                                       static_cast<std::int64_t>(textures) - 1);
}

}  // namespace

ImportLimits import_limits(std::size_t file_bytes) {
    // Importers take up to 30 bytes for one of a small text file, 12 for one of a large file. Half a second for a megabyte is
    // five times what slow ones need.
    const std::size_t small = 480 * kMegabyte + 30 * file_bytes,
                      large = std::max<std::size_t>(1200 * kMegabyte, 12 * file_bytes);
    return {std::min(small, large),
            static_cast<int>(std::min<std::size_t>(300, 3 + file_bytes / (2 * kMegabyte)))};
}

void write_mesh_message(const geom::PolygonMesh& mesh, const ByteSink& sink) {
    const Writer out(sink);
    out.number(kMeshMark);
    out.number(static_cast<std::uint64_t>(mesh.vertex_count()));
    out.list(mesh.positions.data(), static_cast<std::size_t>(mesh.positions.size()));
    out.number(mesh.corner_vertex.size());
    out.number(static_cast<std::uint64_t>(mesh.face_count()));
    out.number(mesh.group_names.size());
    std::vector<int> sizes;
    for (int f = 0; f < mesh.face_count(); ++f) sizes.push_back(mesh.corner_count(f));
    out.list(sizes.data(), sizes.size());
    out.list(mesh.corner_vertex.data(), mesh.corner_vertex.size());
    out.list(mesh.face_group.data(), mesh.face_group.size());
    for (const std::string& name : mesh.group_names) out.text(name);
    out.number(mesh.corner_texcoord.rows() > 0 ? 1 : 0);
    out.list(mesh.corner_texcoord.data(), static_cast<std::size_t>(mesh.corner_texcoord.size()));
    out.number(mesh.textures.size());
    for (const geom::Texture& texture : mesh.textures) {
        out.text(texture.file.string());
        out.text(texture.named_in);
        out.number(texture.embedded.size());
        out.list(texture.embedded.data(), texture.embedded.size());
    }
    out.list(mesh.face_texture.data(), mesh.face_texture.size());
    out.list(mesh.from_file.data(), 16);
    out.number(mesh.in_file_order ? 1 : 0);
    out.number(mesh.notes.size());
    for (const std::string& note : mesh.notes) out.text(note);
    out.number(kEndMark);
}

void write_mesh_message(const MeshProblem& problem, const ByteSink& sink) {
    const Writer out(sink);
    out.number(kProblemMark);
    out.text(problem.place);
    out.text(problem.expected);
    out.text(problem.found);
    out.number(kEndMark);
}

std::optional<geom::PolygonMesh> read_mesh_message(const ByteSource& source, MeshProblem& problem) {
    constexpr std::uint64_t kAny = ~std::uint64_t{0};
    Reader in(source);
    geom::PolygonMesh mesh;
    const std::uint64_t mark = in.number(kAny);
    if (mark == kProblemMark) {
        problem.place = in.text();
        problem.expected = in.text();
        problem.found = in.text();
    } else if (mark == kMeshMark) {
        const std::uint64_t vertices = in.number(detail::kMostVertices);
        const std::vector<double> numbers = in.list<double>(3 * vertices);
        if (!in.sound()) return std::nullopt;
        mesh.positions = Eigen::Map<const Points>(numbers.data(), static_cast<long>(vertices), 3);
        read_faces(in, vertices, mesh);
        if (!in.sound()) return std::nullopt;
        read_textures(in, mesh);
        const std::vector<double> matrix = in.list<double>(16);
        if (!in.sound()) return std::nullopt;
        mesh.from_file = Eigen::Map<const Eigen::Matrix4d>(matrix.data());
        in.require(mesh.from_file.allFinite());
        mesh.in_file_order = in.number(1) == 1;
        const std::uint64_t notes = in.number(kMostNames);
        for (std::uint64_t n = 0; in.sound() && n < notes; ++n) mesh.notes.push_back(in.text());
    } else {
        return std::nullopt;
    }
    in.require(in.number(kAny) == kEndMark);
    if (!in.sound()) return std::nullopt;
    return mesh;
}

}  // namespace risorius::io
