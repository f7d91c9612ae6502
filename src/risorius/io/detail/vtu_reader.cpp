// SPDX-License-Identifier: MIT
// Unstructured grids of VTK in XML: text, base64 and raw blocks, also packed by zlib. Source: VTK File Formats, in The VTK User's Guide, Kitware, 11th edition, 2010.
#include <algorithm>
#include <bit>
#include <charconv>
#include <map>
#include <optional>
#include <set>

#include "risorius/core/error.h"
#include "risorius/io/detail/base64_digit.h"
#include "risorius/io/detail/inflate.h"
#include "risorius/io/detail/mesh_limits.h"
#include "risorius/io/detail/mesh_scanner.h"
#include "risorius/io/detail/tet_mesh_builder.h"
#include "risorius/io/detail/vtk_cells.h"

namespace risorius::io::detail {

namespace {

constexpr std::size_t kMostNodesOfACell = 64;

using Attributes = std::map<std::string, std::string, std::less<>>;

struct XmlName {
    const char* name;
    Scalar type;
};
constexpr XmlName kXmlNames[] = {{"Int8", Scalar::kInt8},     {"UInt8", Scalar::kUInt8},
                                 {"Int16", Scalar::kInt16},   {"UInt16", Scalar::kUInt16},
                                 {"Int32", Scalar::kInt32},   {"UInt32", Scalar::kUInt32},
                                 {"Int64", Scalar::kInt64},   {"UInt64", Scalar::kUInt64},
                                 {"Float32", Scalar::kFloat}, {"Float64", Scalar::kDouble}};

/// Decodes until a letter that base64 does not have; padding may stand in the middle, where one block ends and another begins.
std::string decoded_base64(std::string_view text, std::size_t most_bytes) {
    std::string out;
    std::uint32_t bits = 0;
    int letters = 0, padding = 0;
    for (const char c : text) {
        if (c == ' ' || c == '\n' || c == '\r' || c == '\t') continue;
        const int digit = base64_digit(c);
        if (digit < 0 && c != '=') break;
        padding += c == '=';
        bits = (bits << 6) | static_cast<std::uint32_t>(std::max(digit, 0));
        if (++letters < 4) continue;
        for (int k = 2; k >= padding && k >= 0; --k)
            out += static_cast<char>(bits >> (8 * k) & 255);
        bits = 0;
        letters = padding = 0;
        if (out.size() >= most_bytes) break;
    }
    return out;
}

class VtuReader {
  public:
    VtuReader(std::string_view bytes, const std::string& name)
        : text_(bytes), name_(name), cells_(name) {}

    TetMesh read() {
        find_appended();
        while (next_tag()) read_tag();
        if (pieces_ != 1) throw Error(name_, "one Piece", std::to_string(pieces_));
        return cells_.finish();
    }

  private:
    [[noreturn]] void fail(const std::string& expected, const std::string& found) const {
        MeshScanner at(text_, name_);
        at.go_to(at_);
        at.fail(expected, found);
    }

    /// Raw bytes may look like tags: they are no part of what is read as XML.
    void find_appended() {
        const std::size_t begin = text_.find("<AppendedData");
        if (begin == std::string_view::npos) return;
        xml_end_ = begin;
        const std::size_t end = text_.find('>', begin), underscore = text_.find('_', end);
        if (end == std::string_view::npos || underscore == std::string_view::npos) {
            at_ = begin;
            fail("an underscore before the data", "none");
        }
        appended_ = underscore + 1;
        raw_ = text_.substr(begin, end - begin).find("\"raw\"") != std::string_view::npos;
    }

    /// Goes behind the next tag, and keeps its name and attributes. Returns false at the end.
    bool next_tag() {
        const std::size_t begin = text_.find('<', at_);
        if (begin == std::string_view::npos || begin >= xml_end_) return false;
        const bool comment = text_.substr(begin).starts_with("<!--");
        const std::size_t end = comment ? text_.find("-->", begin + 4) : text_.find('>', begin);
        at_ = begin;
        if (end == std::string_view::npos) fail("the end of the tag", "the end of the file");
        tag_.clear();
        attributes_.clear();
        at_ = end + (comment ? 3 : 1);
        if (comment) return true;
        std::string_view inside = text_.substr(begin + 1, end - begin - 1);
        const std::size_t name_end = std::min(inside.find_first_of(" \t\r\n/", 1), inside.size());
        tag_ = std::string(inside.substr(0, name_end));
        inside.remove_prefix(name_end);
        for (std::size_t equals; (equals = inside.find('=')) != std::string_view::npos;) {
            std::string_view key = inside.substr(0, equals);
            while (!key.empty() && std::string_view(" \t\r\n").find(key.front()) != key.npos)
                key.remove_prefix(1);
            while (!key.empty() && std::string_view(" \t\r\n").find(key.back()) != key.npos)
                key.remove_suffix(1);
            const std::size_t open = inside.find_first_of("\"'", equals);
            const std::size_t close =
                open == std::string_view::npos ? open : inside.find(inside[open], open + 1);
            if (close == std::string_view::npos) fail("a value in quotes", "none");
            attributes_[std::string(key)] = std::string(inside.substr(open + 1, close - open - 1));
            inside.remove_prefix(close + 1);
        }
        return true;
    }

    std::string attribute(std::string_view key) const {
        const auto found = attributes_.find(key);
        return found == attributes_.end() ? "" : found->second;
    }

    void read_tag() {
        if (tag_ == "VTKFile") {
            if (attribute("type") != "UnstructuredGrid")
                fail("the type UnstructuredGrid", "\"" + attribute("type").substr(0, 24) + "\"");
            compressed_ = !attribute("compressor").empty();
            if (compressed_ && attribute("compressor") != "vtkZLibDataCompressor")
                fail("a file without compression, or with vtkZLibDataCompressor",
                     attribute("compressor").substr(0, 40));
            swapped_ = (attribute("byte_order") == "BigEndian") ==
                       (std::endian::native == std::endian::little);
            long_header_ = attribute("header_type") == "UInt64";
        } else if (tag_ == "Piece") {
            ++pieces_;
            // Packed, what is said of each takes some bytes at least.
            const std::size_t most = text_.size() / 2;
            point_count_ = count("NumberOfPoints", std::min(kMostVertices, most));
            cell_count_ = count("NumberOfCells", std::min(4 * kMostTets, most));
        } else if (tag_ == "Points" || tag_ == "Cells" || tag_ == "CellData" ||
                   tag_ == "PointData") {
            section_ = tag_;
        } else if (tag_ == "DataArray") {
            read_array();
        }
    }

    /// An attribute that is a number.
    std::size_t count(std::string_view key, std::size_t most) const {
        const std::string text = attribute(key);
        std::size_t value = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error != std::errc() || end != text.data() + text.size() || value > most)
            fail(std::string(key) + ", an integer in [0, " + std::to_string(most) + "]",
                 "\"" + text.substr(0, 24) + "\"");
        return value;
    }

    void read_array() {
        const std::string name = attribute("Name");
        const bool fibres = attribute("NumberOfComponents") == "3" && is_fibre_name(name);
        if (section_ == "Points") {
            cells_.points = values_once("points", 3 * point_count_);
        } else if (section_ == "Cells" && name == "connectivity") {
            cells_.connectivity = values_once(name, {});
        } else if (section_ == "Cells" && name == "offsets") {
            cells_.offsets = values_once(name, cell_count_);
            cells_.offsets.insert(cells_.offsets.begin(), 0);
        } else if (section_ == "Cells" && name == "types") {
            cells_.types = values_once(name, cell_count_);
        } else if (section_ == "CellData" && is_tag_name(name)) {
            cells_.tags = values_once(name, cell_count_);
        } else if (section_ == "CellData" && fibres) {
            cells_.cell_fibres = values_once("fibres of cells", 3 * cell_count_);
        } else if (section_ == "PointData" && fibres) {
            cells_.point_fibres = values_once("fibres of points", 3 * point_count_);
        }
    }

    /// Many arrays could name the same appended data otherwise.
    std::vector<double> values_once(const std::string& what, std::optional<std::size_t> expected) {
        if (!read_.insert(what).second) fail("one array of " + what, "another one");
        return values(expected);
    }

    Scalar type() const {
        for (const XmlName& known : kXmlNames)
            if (attribute("type") == known.name) return known.type;
        fail("a type of numbers", "\"" + attribute("type").substr(0, 24) + "\"");
    }

    /// The numbers of the array. `expected`: how many; none: as many as there are.
    std::vector<double> values(std::optional<std::size_t> expected) {
        const std::string form = attribute("format");
        const Scalar of = type();
        std::vector<double> out;
        if (form == "ascii") {
            const std::size_t end = std::min(text_.find('<', at_), text_.size());
            MeshScanner in(text_.substr(0, end), name_);
            in.go_to(at_);
            while (true) {
                const std::size_t before = in.position();
                if (in.word().empty()) break;
                in.go_to(before);
                out.push_back(in.number(attribute("Name")));
            }
        } else if (form == "binary") {
            const std::size_t end = std::min(text_.find('<', at_), text_.size());
            out = of_block(decoded_base64(text_.substr(at_, end - at_), std::string::npos), of,
                           expected);
        } else if (form == "appended") {
            const std::size_t offset = count("offset", text_.size());
            if (appended_ == 0 || appended_ + offset > text_.size())
                fail("an offset within the appended data", std::to_string(offset));
            const std::string_view from = text_.substr(appended_ + offset);
            if (raw_) {
                out = of_block(from, of, expected);
            } else {
                std::string head = decoded_base64(from, header_bytes());
                if (compressed_) head = decoded_base64(from, head_bytes(head));
                out = of_block(decoded_base64(from, head_bytes(head) + block_bytes(head)), of,
                               expected);
            }
        } else {
            fail("the format ascii, binary or appended", "\"" + form.substr(0, 24) + "\"");
        }
        if (expected && out.size() != *expected)
            fail(std::to_string(*expected) + " numbers of " + attribute("Name"),
                 std::to_string(out.size()));
        return out;
    }

    std::size_t header_bytes() const { return long_header_ ? 8 : 4; }
    /// One number of the header of a block.
    std::size_t header_number(std::string_view block, std::size_t index) const {
        if (block.size() / header_bytes() <= index) fail("the length of a block", "fewer bytes");
        const double number = numbers_of(block.substr(index * header_bytes(), header_bytes()),
                                         long_header_ ? Scalar::kUInt64 : Scalar::kUInt32, swapped_)
                                  .front();
        if (!(number <= 1e12)) fail("a block within the file", "one of more than 1e12 bytes");
        return static_cast<std::size_t>(number);
    }
    /// The length of the header: a length; or the number of packed parts, the size of a part and of the last one, and packed sizes.
    std::size_t head_bytes(std::string_view block) const {
        if (!compressed_) return header_bytes();
        const std::size_t parts = header_number(block, 0);
        if (parts > text_.size())
            fail("a block within the file", "one of " + std::to_string(parts) + " parts");
        return (3 + parts) * header_bytes();
    }
    /// The length of a block behind its header.
    std::size_t block_bytes(std::string_view block) const {
        std::size_t length = 0;
        if (!compressed_) {
            length = header_number(block, 0);
        } else {
            for (std::size_t part = header_number(block, 0); part > 0; --part)
                length += header_number(block, 2 + part);
        }
        if (length > text_.size())
            fail("a block within the file", "one of " + std::to_string(length) + " bytes");
        return length;
    }
    std::vector<double> of_block(std::string_view block, Scalar of,
                                 std::optional<std::size_t> expected) const {
        const std::size_t head = head_bytes(block), length = block_bytes(block);
        if (block.size() < head || length > block.size() - head)
            fail("a block of " + std::to_string(head + length) + " bytes",
                 std::to_string(block.size()));
        if (!compressed_) return numbers_of(block.substr(head, length), of, swapped_);
        // A file packs a thousandth of what it can unpack to: no more than there is room for in the mesh
        const std::size_t most = bytes_of(of) * expected.value_or(std::min(
                                                    kMostNodesOfACell * cell_count_, kMostCorners));
        std::string unpacked;
        const std::size_t parts = header_number(block, 0), last = header_number(block, 2);
        std::size_t at = head;
        for (std::size_t part = 0; part < parts; ++part) {
            const std::size_t packed = header_number(block, 3 + part);
            const std::size_t bytes =
                part + 1 == parts && last > 0 ? last : header_number(block, 1);
            const std::size_t before = unpacked.size();
            if (bytes == 0) fail("parts of a block with bytes", "an empty one");
            if (bytes > most - before)
                fail("at most " + std::to_string(most) + " bytes in a block",
                     std::to_string(before + bytes));
            const std::string wrong = inflate(block.substr(at, packed), bytes, unpacked);
            if (!wrong.empty() || unpacked.size() - before != bytes)
                fail("a block of zlib with " + std::to_string(bytes) + " bytes",
                     wrong.empty() ? std::to_string(unpacked.size() - before) + " bytes" : wrong);
            at += packed;
        }
        return numbers_of(unpacked, of, swapped_);
    }

    std::string_view text_;
    std::string name_;
    VtkCells cells_;
    std::size_t at_ = 0, xml_end_ = std::string_view::npos, appended_ = 0;
    bool raw_ = false, swapped_ = false, long_header_ = false, compressed_ = false;
    std::string tag_, section_;
    std::set<std::string> read_;  ///< arrays
    Attributes attributes_;
    int pieces_ = 0;
    std::size_t point_count_ = 0, cell_count_ = 0;
};

}  // namespace

TetMesh read_vtu(std::string_view bytes, const std::string& name) {
    return VtuReader(bytes, name).read();
}

}  // namespace risorius::io::detail
