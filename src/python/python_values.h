// SPDX-License-Identifier: MIT
/// \file
/// Values between Python and the library: JSON, and arrays that look at memory of the library.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <nlohmann/json.hpp>

#include "risorius/core/json_cursor.h"

namespace risorius::python {

/// The JSON of a Python value: None, booleans, numbers, strings, lists, tuples and dicts with strings as keys. Throws TypeError for
/// anything else.
Json json_of(const pybind11::handle& value);

/// The Python value of JSON.
pybind11::object object_of(const Json& json);

/// An array of rows x cols numbers without a copy, which cannot be written to. `owner` is the Python object that keeps the memory alive.
template <typename Number>
pybind11::array view_of(const Number* data, pybind11::ssize_t rows, pybind11::ssize_t cols,
                        const pybind11::handle& owner) {
    pybind11::array_t<Number> array({rows, cols}, data, owner);
    array.attr("flags").attr("writeable") = false;
    return array;
}

}  // namespace risorius::python
