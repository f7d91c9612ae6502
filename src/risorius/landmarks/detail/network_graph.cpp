// SPDX-License-Identifier: MIT
#include "risorius/landmarks/detail/network_graph.h"

#include <cstring>
#include <map>
#include <nlohmann/json.hpp>

#include "risorius/core/error.h"
#include "risorius/core/json_cursor.h"
#include "risorius/core/read_file.h"
#include "risorius/core/sha256.h"
#include "risorius/core/types.h"

namespace risorius::landmarks {

namespace fs = std::filesystem;

namespace {

constexpr FileKind kWeights{"a file of weights", 4 * kMegabyte};

void check_known(const fs::path& file, const std::string& sha256) {
    check_file(file, kWeights);
    if (const std::string found = sha256_of_file(file); found != sha256)
        throw Error(file.string(), "the weights with the SHA-256 " + sha256, found);
}

/// The constants of the graph by name. Floating-point numbers have 16 or 32 bits in the file, integers 32.
std::map<std::string, std::vector<float>> read_constants(const JsonCursor& manifest,
                                                         const std::vector<std::uint8_t>& bytes) {
    std::map<std::string, std::vector<float>> out;
    std::size_t next = 0;
    for (const JsonCursor& group : manifest.items())
        for (const JsonCursor& item : group.at("weights").items()) {
            std::size_t count = 1;
            for (const JsonCursor& size : item.at("shape").items())
                count *= static_cast<std::size_t>(size.integer(0, 1 << 20));
            const bool half = item.has("quantization");
            const bool whole = item.at("dtype").string() == "int32";
            const std::size_t width = half ? 2 : 4;
            if (next + width * count > bytes.size())
                item.fail("numbers that the file of weights has");
            std::vector<float>& values = out[item.at("name").string()];
            for (std::size_t i = 0; i < count; ++i, next += width) {
                std::uint32_t bits = 0;
                std::memcpy(&bits, bytes.data() + next, width);
                values.push_back(half    ? static_cast<float>(Eigen::numext::bit_cast<Eigen::half>(
                                            static_cast<std::uint16_t>(bits)))
                                 : whole ? static_cast<float>(static_cast<std::int32_t>(bits))
                                         : Eigen::numext::bit_cast<float>(bits));
            }
        }
    return out;
}

/// The second number of a list of four, as strings: [1, 2, 2, 1].
int second_of(const JsonCursor& node, const std::string& attribute) {
    return std::stoi(node.at("attr").at(attribute).at("list").at("i").items().at(1).string());
}

bool is_padded(const JsonCursor& node) {
    return node.at("attr").at("padding").at("s").string() == "U0FNRQ==";  // "SAME" in base64
}

}  // namespace

/// The graph as steps in the order of their results.
struct NetworkGraph::Impl {
    enum class Kind { kConvolve, kByChannel, kAdd, kSlopes, kPool, kChannels, kCopy };
    struct Step {
        Kind kind;
        std::vector<int> inputs;  // steps before; -1: the picture
        Filters filters;
        std::vector<float> slopes;
        int size = 0;  // of a pool; channels
    };
    std::vector<Step> steps;
    std::vector<int> wanted;  // the steps of the results

    // While reading
    std::map<std::string, JsonCursor> nodes;
    std::map<std::string, std::vector<float>> constants;
    std::map<std::string, std::vector<int>> shapes;
    std::map<std::string, int> step_of;

    int add(const std::string& name);
    Filters filters_of(const JsonCursor& node, bool by_channel);
};

Filters NetworkGraph::Impl::filters_of(const JsonCursor& node, bool by_channel) {
    const std::string weights = node.at("input").items().at(1).string();
    const std::vector<int>& shape = shapes.at(weights);
    Filters out;
    out.rows = shape[0];
    out.columns = shape[1];
    out.channels_in = shape[2];
    out.channels_out = shape[3];
    out.stride = second_of(node, "strides");
    out.padded = is_padded(node);
    out.weights = constants.at(weights);
    if (!by_channel) out.bias = constants.at(node.at("input").items().at(2).string());
    return out;
}

/// Adds the step of a node, and first those it needs. Returns its index.
int NetworkGraph::Impl::add(const std::string& name) {
    if (const auto known = step_of.find(name); known != step_of.end()) return known->second;
    const JsonCursor& node = nodes.at(name);
    const std::string op = node.at("op").string();
    if (op == "Placeholder") return step_of[name] = -1;
    const std::vector<JsonCursor> inputs = node.at("input").items();
    const auto input = [&](std::size_t i) { return inputs.at(i).string(); };
    Step step{Kind::kCopy, {add(input(0))}, {}, {}, 0};
    if (op == "_FusedConv2D") {
        step.kind = Kind::kConvolve;
        step.filters = filters_of(node, false);
        if (inputs.size() > 3) step.slopes = constants.at(input(3));
    } else if (op == "DepthwiseConv2dNative") {
        step.kind = Kind::kByChannel;
        step.filters = filters_of(node, true);
    } else if (op == "AddV2") {
        step.kind = Kind::kAdd;
        step.inputs.push_back(add(input(1)));
    } else if (op == "Prelu") {
        step.kind = Kind::kSlopes;
        step.slopes = constants.at(input(1));
    } else if (op == "MaxPool") {
        step.kind = Kind::kPool;
        step.size = second_of(node, "ksize");
    } else if (op == "Pad") {
        step.kind = Kind::kChannels;
        step.size = static_cast<int>(constants.at(input(1)).back());
    } else if (op != "Reshape" && op != "Identity" && op != "Sigmoid") {
        node.at("op").fail("a kind of layer of the networks for faces and eyes");
    }
    steps.push_back(std::move(step));
    return step_of[name] = static_cast<int>(steps.size()) - 1;
}

NetworkGraph::NetworkGraph(const fs::path& folder, const NetworkFiles& files,
                           const std::vector<std::string>& results)
    : impl_(std::make_unique<Impl>()) {
    const fs::path graph = folder / files.graph, weights = folder / files.weights;
    check_known(graph, files.graph_sha256);
    check_known(weights, files.weights_sha256);
    const JsonCursor json = JsonCursor::read_file(graph);
    impl_->constants = read_constants(json.at("weightsManifest"), read_bytes(weights, kWeights));
    for (const JsonCursor& group : json.at("weightsManifest").items())
        for (const JsonCursor& item : group.at("weights").items())
            for (const JsonCursor& size : item.at("shape").items())
                impl_->shapes[item.at("name").string()].push_back(size.integer(0, 1 << 20));
    for (const JsonCursor& node : json.at("modelTopology").at("node").items())
        impl_->nodes.emplace(node.at("name").string(), node);
    for (const std::string& name : results) impl_->wanted.push_back(impl_->add(name));
    impl_->nodes.clear();
    impl_->constants.clear();
}

NetworkGraph::~NetworkGraph() = default;

std::vector<Picture> NetworkGraph::run(const Picture& picture) const {
    std::vector<Picture> results(impl_->steps.size());
    // What no later step needs is let go of, so that its memory serves the next ones.
    std::vector<std::size_t> last_use(results.size(), 0);
    for (std::size_t i = 0; i < results.size(); ++i)
        for (const int input : impl_->steps[i].inputs)
            if (input >= 0) last_use[static_cast<std::size_t>(input)] = i;
    for (const int step : impl_->wanted)
        if (step >= 0) last_use[static_cast<std::size_t>(step)] = results.size();
    const auto result = [&](int step) -> const Picture& {
        return step < 0 ? picture : results[static_cast<std::size_t>(step)];
    };
    for (std::size_t i = 0; i < results.size(); ++i) {
        const Impl::Step& step = impl_->steps[i];
        const Picture& in = result(step.inputs[0]);
        switch (step.kind) {
            case Impl::Kind::kConvolve:
                results[i] = convolved(in, step.filters);
                if (!step.slopes.empty()) apply_slopes(step.slopes, results[i]);
                break;
            case Impl::Kind::kByChannel:
                results[i] = convolved_by_channel(in, step.filters);
                break;
            case Impl::Kind::kAdd:
                results[i] = sum_of(in, result(step.inputs[1]));
                break;
            case Impl::Kind::kSlopes:
                results[i] = in;
                apply_slopes(step.slopes, results[i]);
                break;
            case Impl::Kind::kPool:
                results[i] = pooled(in, step.size);
                break;
            case Impl::Kind::kChannels:
                results[i] = with_channels(in, in.channels + step.size);
                break;
            case Impl::Kind::kCopy:
                results[i] = in;
                break;
        }
        for (const int input : step.inputs)
            if (input >= 0 && last_use[static_cast<std::size_t>(input)] == i)
                results[static_cast<std::size_t>(input)] = {};
    }
    std::vector<Picture> out;
    for (const int step : impl_->wanted) out.push_back(result(step));
    return out;
}

}  // namespace risorius::landmarks
