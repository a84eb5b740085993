// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_SHAKE_HPP
#define RSACKERMANN_SAMPLES_SHAKE_HPP

#include "opencv2/core.hpp"
#include <string>
#include <vector>

namespace street {

/** How a camera turns against its mount: damped oscillators that noise excites.

A sum of waves with the spectrum of such oscillators, so that the angles of any instant are exact, whatever is asked for
before. The axes are those of the camera: x to the right, y down, z ahead.
*/
class Shake
{
public:
    enum Kind {
        NONE,
        SUSPENSION, //!< of the car: pitch and roll about 1.4 Hz
        ENGINE,     //!< 20 to 40 Hz about all axes
        PHONE       //!< on an arm: about 7 Hz, pitch above all
    };

    //! The words for Kind, in its order.
    static const std::vector<std::string>& words();
    //! The rate of the pitch, root mean square in radians per second, that is usual for a kind.
    static double usualRate(int kind);

    //! A camera that doesn't shake.
    Shake() : Shake(NONE, 0, 0) {}
    //! @param rate of the pitch, root mean square in radians per second. @param seed the same one shakes alike.
    Shake(int kind, double rate, unsigned seed);

    int kind() const { return kind_; }
    double rate() const { return rate_; }
    unsigned seed() const { return seed_; }

    //! One that stays turned as this one is at a time, seconds.
    Shake heldAt(double seconds) const;

    //! Turns the frame of the camera at a time, seconds, into that of its mount.
    cv::Matx33d rotation(double seconds) const;

private:
    struct Wave
    {
        double frequency, phase; // radians per second, radians
        cv::Vec3d amplitude;     // radians about the axes, of which one isn't 0
    };

    int kind_;
    double rate_;
    unsigned seed_;
    std::vector<Wave> waves_;
};

} // namespace street

#endif // RSACKERMANN_SAMPLES_SHAKE_HPP
