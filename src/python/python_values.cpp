// SPDX-License-Identifier: MIT
#include "python/python_values.h"

#include <nlohmann/json.hpp>

namespace py = pybind11;

namespace risorius::python {

Json json_of(const py::handle& value) {
    if (value.is_none()) return nullptr;
    if (py::isinstance<py::bool_>(value)) return value.cast<bool>();
    if (py::isinstance<py::int_>(value)) return value.cast<long long>();
    if (py::isinstance<py::float_>(value)) return value.cast<double>();
    if (py::isinstance<py::str>(value)) return value.cast<std::string>();
    if (py::isinstance<py::dict>(value)) {
        Json out = Json::object();
        for (const auto& [key, entry] : value.cast<py::dict>()) {
            if (!py::isinstance<py::str>(key))
                throw py::type_error("expected strings as keys, found " +
                                     py::repr(key).cast<std::string>());
            out[key.cast<std::string>()] = json_of(entry);
        }
        return out;
    }
    if (py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value)) {
        Json out = Json::array();
        for (const py::handle entry : value) out.push_back(json_of(entry));
        return out;
    }
    if (py::hasattr(value, "tolist")) return json_of(value.attr("tolist")());  // numpy
    throw py::type_error("expected what JSON can hold, found " +
                         py::repr(value).cast<std::string>());
}

py::object object_of(const Json& json) {
    if (json.is_null()) return py::none();
    if (json.is_boolean()) return py::bool_(json.get<bool>());
    if (json.is_number_integer()) return py::int_(json.get<long long>());
    if (json.is_number()) return py::float_(json.get<double>());
    if (json.is_string()) return py::str(json.get<std::string>());
    if (json.is_array()) {
        py::list out;
        for (const Json& entry : json) out.append(object_of(entry));
        return out;
    }
    py::dict out;
    for (const auto& [key, entry] : json.items()) out[py::str(key)] = object_of(entry);
    return out;
}

}  // namespace risorius::python
