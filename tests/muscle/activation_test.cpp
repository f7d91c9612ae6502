// SPDX-License-Identifier: MIT
#include "risorius/muscle/activation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace risorius::muscle {
namespace {

constexpr ActivationTimes kThelen{0.010, 0.040};
/// Eyelid muscles of rigs/standard/muscles.json.
constexpr ActivationTimes kEyelid{0.025, 0.045};

constexpr ActivationLaw kSmooth{.form = ActivationLaw::Form::kSmooth};

/// First time at which activation has crossed `level`, starting from a, in steps of 0.1 ms.
double time_to(double level, double a, double u, const ActivationTimes& times) {
    const double h = 1e-4;
    const bool up = u > a;
    for (int i = 1; i < 20000; ++i) {
        a = advance_activation(a, u, times, h);
        if (up ? a >= level : a <= level) return i * h;
    }
    return std::numeric_limits<double>::infinity();
}

// Thelen 2003 with t_act = 10 ms and t_deact = 40 ms, integrated with h = 0.1 ms; times are read to 0.1 ms.
TEST(Activation, RisesAndFallsAtThePublishedTimes) {
    EXPECT_NEAR(time_to(0.5, 0, 1, kThelen), 6.4e-3, 0.15e-3);
    EXPECT_NEAR(time_to(0.9, 0, 1, kThelen), 32.5e-3, 0.15e-3);
    EXPECT_NEAR(time_to(0.5, 1, 0, kThelen), 17.9e-3, 0.15e-3);
    EXPECT_NEAR(time_to(0.1, 1, 0, kThelen), 94.3e-3, 0.15e-3);
}

TEST(Activation, AgreesWithTheClosedSolutionOfASaturatingRise) {
    // u = 1: (0.5 + 1.5 a)/(1 - a) da = dt / t_act, so t/t_act = -2 ln(1 - a) - 1.5 a.
    for (double t : {1e-3, 5e-3, 10e-3, 20e-3, 50e-3}) {
        const double a = advance_activation(0, 1, kThelen, t);
        const double exact = kThelen.t_act_s * (-2 * std::log(1 - a) - 1.5 * a);
        EXPECT_NEAR(exact, t, 0.2e-3) << "t = " << t;  // first order in the inner step of 0.25 ms
    }
}

TEST(Activation, IsMonotoneAndNeverPassesTheExcitation) {
    for (double h : {1e-4, 1e-3, 1.0 / 60, 0.5}) {
        double a = 0;
        for (int i = 0; i < 200; ++i) {
            const double next = advance_activation(a, 0.7, kThelen, h);
            EXPECT_GE(next, a);
            EXPECT_LE(next, 0.7);
            a = next;
        }
        for (int i = 0; i < 200; ++i) {
            const double next = advance_activation(a, 0.0, kThelen, h);
            EXPECT_LE(next, a);
            EXPECT_GE(next, 0.0);
            a = next;
        }
    }
}

TEST(Activation, RestStaysAtRest) { EXPECT_EQ(advance_activation(0, 0, kThelen, 1.0), 0.0); }

TEST(Activation, OnsetDoesNotDependOnTheFrameRate) {
    const double until_s = 1.0 / 12;  // a multiple of every frame length below
    const double reference = advance_activation(0, 1, kThelen, until_s);
    for (int fps : {12, 24, 36, 48, 60, 120, 240}) {
        double a = 0;
        for (int frame = 0; frame < fps / 12; ++frame)
            a = advance_activation(a, 1, kThelen, 1.0 / fps);
        EXPECT_NEAR(a, reference, 2e-4) << fps << " frames per second";
    }
    double a = 0;
    a = advance_activation(a, 1, kThelen, 1.0 / 60);
    EXPECT_LT(a, 0.8) << "one frame must not reach what takes 32.5 ms";
}

TEST(Activation, ToneTakenAwayFollowsTheSameLawOnTheOtherSide) {
    double up = 0, down = 0;
    for (int i = 0; i < 300; ++i) {
        const double u = i < 100 ? 1.0 : i < 200 ? 0.3 : 0.0;
        up = advance_activation(up, u, kEyelid, 1e-3);
        down = advance_activation(down, -u, kEyelid, 1e-3);
        ASSERT_EQ(down, -up) << "ms " << i;
    }
}

TEST(Activation, CrossingRestFirstReturnsThenGrows) {
    double a = 0.8, previous = 0.8;
    for (int i = 0; i < 300; ++i) {
        a = advance_activation(a, -1, kEyelid, 1e-3);
        ASSERT_LT(a, previous);
        ASSERT_GE(a, -1);
        previous = a;
    }
    EXPECT_LT(a, -0.95);
    // The return to 0 cannot be faster than plain relaxation towards the same excitation with the smallest slope.
    EXPECT_GT(time_to(0, 0.8, -1, kEyelid), 0.010);
}

// Lids: the down phase of a voluntary blink takes 78 ms, the up phase 120-200 ms (VanderWerf et al. 2003).
TEST(Activation, EightyMillisecondPulseClosesTheLidsAndReleasesThem) {
    const double orbicularis_start_s = 0.010, pulse_end_s = 0.080, h = 1e-3;
    double levator = 0, orbicularis = 0, closed_from_s = 0, open_from_s = 0;
    for (int i = 0; i < 400; ++i) {
        const double t = i * h;
        levator = advance_activation(levator, t < pulse_end_s ? -1 : 0, kEyelid, h);
        orbicularis = advance_activation(
            orbicularis, t >= orbicularis_start_s && t < pulse_end_s ? 1 : 0, kEyelid, h);
        const double closure = std::min(-levator, orbicularis);
        if (closed_from_s == 0 && closure > 0.8) closed_from_s = t + h;
        if (closed_from_s > 0 && open_from_s == 0 && t > pulse_end_s &&
            std::max(-levator, orbicularis) < 0.1)
            open_from_s = t + h;
    }
    EXPECT_GT(closed_from_s, 0.060);
    EXPECT_LT(closed_from_s, 0.080);
    EXPECT_GT(open_from_s, 0.180);
    EXPECT_LT(open_from_s, 0.250);
}

// The law of De Groote et al. 2016 with the corrected steepness, integrated with the midpoint rule and h = 1 us.
TEST(SmoothActivation, RisesLikeThelensAndFallsATenthEarlier) {
    const double h = 1e-5;
    const auto time = [&](double level, double a, double u) {
        int i = 0;
        for (const bool up = u > a; up ? a < level : a > level; ++i)
            a = advance_activation(a, u, kThelen, h, kSmooth);
        return i * h;
    };
    EXPECT_NEAR(time(0.5, 0, 1), 6.36e-3, 0.03e-3);
    EXPECT_NEAR(time(0.9, 0, 1), 32.71e-3, 0.03e-3);
    EXPECT_NEAR(time(0.5, 1, 0), 17.85e-3, 0.03e-3);
    EXPECT_NEAR(time(0.1, 1, 0), 82.26e-3, 0.03e-3);
}

TEST(SmoothActivation, WithTheSteepnessFirstPublishedHardlyTellsGrowingFromReturning) {
    const auto ratio_of_rates = [](const ActivationLaw& law) {
        return activation_rate(0.4, 0.9, kThelen, law) / -activation_rate(0.4, -0.1, kThelen, law);
    };
    const ActivationLaw first{.form = ActivationLaw::Form::kSmooth, .steepness = 0.1};
    EXPECT_NEAR(ratio_of_rates(kSmooth), ratio_of_rates({}), 0.01);  // 3.306
    EXPECT_NEAR(ratio_of_rates(first), 1.055, 0.01);
}

TEST(SmoothActivation, RateHasNoJumpWhereActivationMeetsExcitation) {
    for (const double a : {0.2, 0.7}) {
        const double h = 1e-6;
        const auto relaxation = [&](double u, const ActivationLaw& law) {
            return activation_rate(a, u, kThelen, law) / (u - a);
        };
        EXPECT_NEAR(relaxation(a + h, kSmooth), relaxation(a - h, kSmooth), 1e-2);
        EXPECT_GT(std::abs(relaxation(a + h, {}) - relaxation(a - h, {})), 20);
    }
}

TEST(Activation, AShortStepFollowsTheRate) {
    const double h = 1e-7;
    for (const ActivationLaw& law : {ActivationLaw{}, kSmooth})
        for (const double a : {0.0, 0.3, 0.9, -0.4})
            for (const double u : {-0.8, 0.0, 0.5, 1.0})
                EXPECT_NEAR((advance_activation(a, u, kThelen, h, law) - a) / h,
                            activation_rate(a, u, kThelen, law), 2e-3)
                    << a << " to " << u;
}

TEST(Activation, BothLawsAreMonotoneAndNeverPassTheExcitation) {
    for (const ActivationLaw& law : {ActivationLaw{}, kSmooth})
        for (const double h : {1e-4, 1.0 / 60, 0.5})
            for (const double target : {0.7, 0.0}) {
                double a = target == 0 ? 1 : 0;
                for (int i = 0; i < 100; ++i) {
                    const double next = advance_activation(a, target, kThelen, h, law);
                    EXPECT_LE(std::abs(next - target), std::abs(a - target));
                    EXPECT_GE((next - target) * (a - target), 0);
                    a = next;
                }
            }
}

/// Time at which a crosses 0.5, followed in whole frames and a last partial frame.
double onset_at(int fps, const ActivationLaw& law, bool up) {
    const auto at = [&](double t) {
        double a = up ? 0 : 1;
        const int frames = static_cast<int>(t * fps);
        for (int i = 0; i < frames; ++i)
            a = advance_activation(a, up ? 1 : 0, kEyelid, 1.0 / fps, law);
        return advance_activation(a, up ? 1 : 0, kEyelid, t - static_cast<double>(frames) / fps,
                                  law);
    };
    double before = 0, after = 0.1;
    while (after - before > 1e-7) {
        const double t = 0.5 * (before + after);
        ((at(t) > 0.5) == up ? after : before) = t;
    }
    return before;
}

TEST(Activation, OnsetIsTheSameWithinATenthOfAMillisecondAtEveryFrameRate) {
    for (const ActivationLaw& law : {ActivationLaw{}, kSmooth})
        for (const bool up : {true, false}) {
            const double reference = onset_at(1000, law, up);
            for (const int fps : {24, 25, 30, 50, 60, 120})
                EXPECT_NEAR(onset_at(fps, law, up), reference, 1e-4) << fps << " fps";
        }
}

Eigen::VectorXd column_vector(std::initializer_list<double> values) {
    Eigen::VectorXd v(static_cast<Eigen::Index>(values.size()));
    std::copy(values.begin(), values.end(), v.data());
    return v;
}

TEST(ActivationDynamics, EveryColumnFollowsItsOwnTimes) {
    ActivationDynamics dynamics(column_vector({0.010, 0.025}), column_vector({0.040, 0.045}));
    dynamics.advance(column_vector({1.0, -0.5}), {}, 0.020);
    EXPECT_EQ(dynamics.activation()[0], advance_activation(0, 1.0, kThelen, 0.020));
    EXPECT_EQ(dynamics.activation()[1], advance_activation(0, -0.5, kEyelid, 0.020));
}

TEST(ActivationDynamics, DirectActivationBypassesDynamicsAndIsLeftSmoothly) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    ActivationDynamics dynamics(column_vector({0.010, 0.010}), column_vector({0.040, 0.040}));
    dynamics.advance(column_vector({1.0, 1.0}), column_vector({0.6, nan}), 0.005);
    EXPECT_EQ(dynamics.activation()[0], 0.6);
    EXPECT_EQ(dynamics.activation()[1], advance_activation(0, 1, kThelen, 0.005));
    dynamics.advance(column_vector({0.0, 0.0}), column_vector({nan, nan}), 0.005);
    EXPECT_LT(dynamics.activation()[0], 0.6);
    EXPECT_GT(dynamics.activation()[0], 0.4);
}

TEST(ActivationDynamics, ShortPulseActsTheSameAtEveryFrameRate) {
    const auto peak_after = [](int fps) {
        ActivationDynamics dynamics(column_vector({0.025}), column_vector({0.045}));
        Eigen::VectorXd u(1);
        const ActivationDynamics::ExcitationAt pulse = [&u](double t) -> const Eigen::VectorXd& {
            u[0] = t >= 0.011 && t < 0.071 ? 1.0 : 0.0;  // edges inside a frame at every rate below
            return u;
        };
        for (int frame = 0; frame < fps / 12; ++frame)
            dynamics.advance(pulse, {}, frame / double(fps), (frame + 1) / double(fps));
        return dynamics.activation()[0];
    };
    // An edge is met within 1 ms, and activation falls by at most 20 per second.
    for (int fps : {12, 24, 60, 240}) EXPECT_NEAR(peak_after(fps), peak_after(120), 0.02) << fps;
}

}  // namespace
}  // namespace risorius::muscle
