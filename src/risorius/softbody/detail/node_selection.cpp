// SPDX-License-Identifier: MIT
#include "risorius/softbody/detail/node_selection.h"

#include <algorithm>
#include <cmath>

namespace risorius::softbody {
namespace {

constexpr std::array<const char*, 3> kAxisNames = {"a1", "a2", "a3"};
constexpr int kMaxNodes = 100000;  // along one axis; detects a misplaced number

AxisRange read_axis_range(const JsonCursor& json) {
    AxisRange range{.place = json.place()};
    const std::string expected =
        "\"first\", \"last\", an index, [index, index] or {\"from\": 0..1, \"to\": 0..1}";
    if (json.is_string()) {
        const std::string end = json.string();
        if (end != "first" && end != "last") json.fail(expected);
        range.from = range.to = end == "first" ? 0 : -1;
    } else if (json.is_number()) {
        range.from = range.to = json.integer(-kMaxNodes, kMaxNodes);
    } else if (json.is_array()) {
        const auto ends = json.items();
        if (ends.size() != 2) json.fail(expected);
        range.from = ends[0].integer(-kMaxNodes, kMaxNodes);
        range.to = ends[1].integer(-kMaxNodes, kMaxNodes);
    } else if (json.is_object()) {
        json.allow_keys({"from", "to"});
        range.coordinates = true;
        range.from = json.at("from").number({0, 1});
        range.to = json.at("to").number({0, 1});
    } else {
        json.fail(expected);
    }
    return range;
}

/// Ends of a range as positions along the axis, in units of nodes.
std::pair<double, double> ends_in_nodes(const AxisRange& range, int nodes) {
    if (range.coordinates) return {range.from * (nodes - 1), range.to * (nodes - 1)};
    const auto counted = [&](double index) {
        const double from_start = index < 0 ? index + nodes : index;
        if (from_start < 0 || from_start >= nodes)
            throw Error(range.place,
                        "an index in [" + std::to_string(-nodes) + ", " +
                            std::to_string(nodes - 1) + "] of this grid",
                        format_number(index));
        return from_start;
    };
    return {counted(range.from), counted(range.to)};
}

// A coordinate such as 0.4 need not be exactly that of a node.
constexpr double kSlack = 1e-9;

std::array<int, 3> position_of(int node, const tissue::GridShape& grid) {
    return {node / (grid.n * grid.o), node / grid.o % grid.n, node % grid.o};
}

}  // namespace

NodeSelection read_node_selection(const JsonCursor& json, int axes) {
    std::vector<std::string_view> known(kAxisNames.begin(), kAxisNames.begin() + axes);
    known.insert(known.end(), {"corners", "reach"});
    json.allow_keys(known);

    NodeSelection selection;
    bool any = false;
    for (int axis = 0; axis < axes; ++axis) {
        const auto range = json.find(kAxisNames[static_cast<std::size_t>(axis)]);
        if (!range) continue;
        selection.axes[static_cast<std::size_t>(axis)] = read_axis_range(*range);
        any = true;
    }
    if (const auto corners = json.find("corners")) {
        if (any) corners->fail("either axes or corners", "both");
        for (const JsonCursor& corner : corners->items()) {
            const auto ends = corner.items();
            if (static_cast<int>(ends.size()) != axes)
                corner.fail("0 or 1 for each of " + std::to_string(axes) + " axes");
            std::array<int, 3> ends_of{0, 0, 0};
            for (std::size_t axis = 0; axis < ends.size(); ++axis)
                ends_of[axis] = ends[axis].integer(0, 1);
            selection.corners.push_back(ends_of);
        }
        if (const auto reach = json.find("reach")) selection.reach = reach->integer(0, kMaxNodes);
        any = true;
    } else if (const auto reach = json.find("reach")) {
        reach->fail("\"corners\" beside it", "none");
    }
    if (!any) json.fail("nodes named by axes or corners", "none");
    return selection;
}

std::vector<int> select(const NodeSelection& selection, const tissue::GridShape& grid) {
    std::vector<int> nodes;
    if (!selection.corners.empty()) {
        for (const auto& corner : selection.corners) {
            std::array<int, 3> at{};
            for (int axis = 0; axis < 3; ++axis)
                at[static_cast<std::size_t>(axis)] =
                    corner[static_cast<std::size_t>(axis)] * (grid.along(axis) - 1);
            nodes.push_back(grid.index(at[0], at[1], at[2]));
            for (int axis = 0; axis < 3; ++axis) {
                const int count = grid.along(axis);
                for (int step = 1; step <= std::min(selection.reach, count - 1); ++step) {
                    std::array<int, 3> beside = at;
                    beside[static_cast<std::size_t>(axis)] +=
                        at[static_cast<std::size_t>(axis)] == 0 ? step : -step;
                    nodes.push_back(grid.index(beside[0], beside[1], beside[2]));
                }
            }
        }
        std::sort(nodes.begin(), nodes.end());
        nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
        return nodes;
    }

    std::array<std::pair<double, double>, 3> ends;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const int count = grid.along(static_cast<int>(axis));
        ends[axis] = selection.axes[axis] ? ends_in_nodes(*selection.axes[axis], count)
                                          : std::pair<double, double>(0, count - 1);
        if (ends[axis].first > ends[axis].second) std::swap(ends[axis].first, ends[axis].second);
    }
    for (int node = 0; node < grid.size(); ++node) {
        const std::array<int, 3> at = position_of(node, grid);
        bool inside = true;
        for (std::size_t axis = 0; axis < 3; ++axis)
            inside = inside && at[axis] >= ends[axis].first - kSlack &&
                     at[axis] <= ends[axis].second + kSlack;
        if (inside) nodes.push_back(node);
    }
    return nodes;
}

double fraction_along(const NodeSelection& selection, const tissue::GridShape& grid, int axis,
                      int node) {
    const auto& range = selection.axes[static_cast<std::size_t>(axis)];
    if (!range) return 1;
    const auto [from, to] = ends_in_nodes(*range, grid.along(axis));
    if (from == to) return 1;
    const double at = position_of(node, grid)[static_cast<std::size_t>(axis)];
    return std::clamp((at - from) / (to - from), 0.0, 1.0);
}

}  // namespace risorius::softbody
