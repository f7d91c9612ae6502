// How a long run tells how far it is, and how it is asked to stop.
#pragma once

#include <exception>
#include <functional>
#include <string>

namespace risorius {

/// The run was asked to stop; everything it had begun to write is gone.
class Interrupted : public std::exception {
  public:
    const char* what() const noexcept override { return "interrupted"; }
};

/// What film() tells of every frame.
constexpr const char* kRendering = "rendering";

struct Watch {
    std::function<void(double share, const std::string& what)> progress;  ///< share of the run done
    std::function<bool()> stopped;

    /// Throws Interrupted when asked to stop.
    void tell(double share, const std::string& what) const {
        if (stopped && stopped()) throw Interrupted();
        if (progress) progress(share, what);
    }
    /// For a part of the run, from one share of it to another.
    Watch part(double from, double to) const {
        Watch out = *this;
        if (progress)
            out.progress = [whole = progress, from, to](double share, const std::string& what) {
                whole(from + (to - from) * share, what);
            };
        return out;
    }
};

}  // namespace risorius
