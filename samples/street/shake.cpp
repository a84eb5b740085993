// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "shake.hpp"

#include <cmath>

namespace street {

namespace {

struct Oscillator
{
    double lowest, natural, highest; // Hz
    double damping;                  // ratio
    double shares[3];                // of the rates about x, y and z
    double usualRate;                // degrees per second
};

const Oscillator OSCILLATORS[] = {{1, 1, 1, 1, {0, 0, 0}, 0},
                                  {0.3, 1.4, 6, 0.25, {1, 0, 0.7}, 1.5},
                                  {20, 30, 40, 0.1, {1, 0.5, 1}, 5},
                                  {4, 7, 12, 0.15, {1, 0.4, 0.4}, 11}};
const int WAVES = 24; // about each axis

// Of the angle, if the excitation has the same power at all frequencies.
double gain(const Oscillator& o, double hertz)
{
    const double ratio = hertz / o.natural;
    return 1 / std::hypot(1 - ratio * ratio, 2 * o.damping * ratio);
}

} // namespace

const std::vector<std::string>& Shake::words()
{
    static const std::vector<std::string> WORDS = {"none", "suspension", "engine", "phone"};
    return WORDS;
}

double Shake::usualRate(int kind)
{
    return OSCILLATORS[kind].usualRate * CV_PI / 180;
}

Shake::Shake(int kind, double rate, unsigned seed) : kind_(kind), rate_(rate), seed_(seed)
{
    CV_Assert(kind >= NONE && kind <= PHONE && rate >= 0);
    const Oscillator& o = OSCILLATORS[kind];
    cv::RNG rng(seed * 2654435761u + unsigned(kind) + 1);
    for (int axis = 0; axis < 3; axis++)
    {
        const size_t first = waves_.size();
        double squares = 0; // of the rate
        for (int i = 0; i < WAVES && o.shares[axis] > 0; i++)
        {
            // One in each of equal bands, but not at equal distances: the sum has no period.
            const double hertz = o.lowest + (o.highest - o.lowest) * (i + rng.uniform(0., 1.)) / WAVES;
            Wave wave = {2 * CV_PI * hertz, rng.uniform(0., 2 * CV_PI), cv::Vec3d()};
            wave.amplitude[axis] = gain(o, hertz);
            squares += std::pow(wave.amplitude[axis] * wave.frequency, 2) / 2;
            waves_.push_back(wave);
        }
        for (size_t i = first; i < waves_.size(); i++)
            waves_[i].amplitude *= rate * o.shares[axis] / std::sqrt(squares);
    }
}

Shake Shake::heldAt(double seconds) const
{
    Shake held = *this;
    for (Wave& wave : held.waves_)
    {
        wave.phase += wave.frequency * seconds;
        wave.frequency = 0;
    }
    return held;
}

cv::Matx33d Shake::rotation(double seconds) const
{
    cv::Vec3d v;
    for (const Wave& wave : waves_)
        v += wave.amplitude * std::sin(wave.frequency * seconds + wave.phase);
    const double angle = cv::norm(v);
    const double s = angle > 0 ? std::sin(angle) / angle : 1,
                 c = std::pow(angle > 0 ? std::sin(angle / 2) / angle : 0.5, 2) * 2;
    const cv::Matx33d cross(0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0);
    return cv::Matx33d::eye() + cross * s + cross * cross * c;
}

} // namespace street
