// SPDX-License-Identifier: MIT
#include "risorius/softbody/detail/material_region.h"

#include <limits>

namespace risorius::softbody {
namespace {

constexpr Range kNotNegative{0, std::numeric_limits<double>::infinity()};

/// "11" .. "33" of a tensor with this many rows, with the indices in either order.
std::vector<std::string_view> tensor_keys(int axes) {
    static constexpr std::array<std::string_view, 1> one = {"11"};
    static constexpr std::array<std::string_view, 4> two = {"11", "22", "12", "21"};
    static constexpr std::array<std::string_view, 9> three = {"11", "22", "33", "12", "21",
                                                              "13", "31", "23", "32"};
    if (axes == 1) return {one.begin(), one.end()};
    if (axes == 2) return {two.begin(), two.end()};
    return {three.begin(), three.end()};
}

/// Fills `number` and `given` from a plain number or an object of tensor entries. The result is symmetric.
void read_entries(const JsonCursor& json, int axes, Mat3& number, Mat3& given) {
    if (axes == 0 || json.is_number()) {
        number.setConstant(json.number(kNotNegative));
        given.setOnes();
        return;
    }
    if (!json.is_object()) json.fail("a number or an object like {\"11\": 1, \"12\": 0.5}");
    json.allow_keys(tensor_keys(axes));
    given.setZero();
    for (const std::string& key : json.keys()) {
        const int i = key[0] - '1', j = key[1] - '1';
        const JsonCursor entry = json.at(key);
        const double value = entry.number(kNotNegative);
        if (given(i, j) != 0 && number(i, j) != value)
            entry.fail("the same number as in \"" + std::string{key[1], key[0]} +
                       "\", the tensor being symmetric");
        number(i, j) = number(j, i) = value;
        given(i, j) = given(j, i) = 1;
    }
}

std::vector<MaterialChange> read_changes(const JsonCursor& json,
                                         const std::vector<Quantity>& quantities, bool factor) {
    std::vector<std::string_view> keys;
    for (const Quantity& quantity : quantities)
        keys.push_back(factor ? quantity.name : quantity.key);
    json.allow_keys(keys);
    std::vector<MaterialChange> changes;
    for (const Quantity& quantity : quantities) {
        const auto entry = json.find(factor ? quantity.name : quantity.key);
        if (!entry) continue;
        MaterialChange change{.quantity = std::string(quantity.name), .factor = factor};
        read_entries(*entry, quantity.axes, change.number, change.given);
        changes.push_back(change);
    }
    return changes;
}

}  // namespace

Mat3 read_tensor(const JsonCursor& json, int axes) {
    Mat3 number = Mat3::Zero(), given = Mat3::Zero();
    read_entries(json, axes, number, given);
    for (int i = 0; i < axes; ++i)
        if (given(i, i) == 0) {
            const std::string key = std::to_string(i + 1) + std::to_string(i + 1);
            json.fail("the diagonal entry \"" + key + "\"", "none");
        }
    for (int i = 0; i < axes; ++i)
        for (int j = 0; j < axes; ++j)
            if (given(i, j) == 0) number(i, j) = 0.5 * (number(i, i) + number(j, j));
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            if (i >= axes || j >= axes) number(i, j) = 0;
    return number;
}

std::vector<MaterialRegion> read_regions(const JsonCursor& json,
                                         const std::vector<Quantity>& quantities, int axes) {
    std::vector<MaterialRegion> regions;
    for (const JsonCursor& entry : json.items()) {
        entry.allow_keys({"nodes", "factors", "values", "graded"});
        MaterialRegion region;
        region.nodes = read_node_selection(entry.at("nodes"), axes);
        if (const auto factors = entry.find("factors"))
            region.changes = read_changes(*factors, quantities, /*factor=*/true);
        if (const auto values = entry.find("values")) {
            const auto more = read_changes(*values, quantities, /*factor=*/false);
            region.changes.insert(region.changes.end(), more.begin(), more.end());
        }
        if (region.changes.empty()) entry.fail("\"factors\" or \"values\" that change something");
        if (const auto graded = entry.find("graded")) {
            static const std::vector<std::string_view> names = {"a1", "a2", "a3"};
            const std::string name = graded->one_of({names.begin(), names.begin() + axes});
            region.graded_axis = name[1] - '1';
            if (!region.nodes.axes[static_cast<std::size_t>(region.graded_axis)])
                graded->fail("an axis that \"nodes\" gives a range of");
        }
        regions.push_back(std::move(region));
    }
    return regions;
}

void for_each_change(
    const std::vector<MaterialRegion>& regions, const tissue::GridShape& grid,
    const std::function<void(int node, const MaterialChange& change, double fraction)>& change) {
    for (const MaterialRegion& region : regions)
        for (const int node : select(region.nodes, grid)) {
            const double fraction =
                region.graded_axis < 0
                    ? 1
                    : fraction_along(region.nodes, grid, region.graded_axis, node);
            for (const MaterialChange& one : region.changes) change(node, one, fraction);
        }
}

double changed(double before, const MaterialChange& change, double fraction) {
    const double after = change.factor ? before * change.number(0, 0) : change.number(0, 0);
    return before + fraction * (after - before);
}

Mat3 changed(const Mat3& before, const MaterialChange& change, double fraction) {
    Mat3 after = before;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            if (change.given(i, j) == 0) continue;
            const double whole =
                change.factor ? before(i, j) * change.number(i, j) : change.number(i, j);
            after(i, j) = before(i, j) + fraction * (whole - before(i, j));
        }
    return after;
}

}  // namespace risorius::softbody
