// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_PERF_RENDERED_DRIVE_HPP
#define RSACKERMANN_PERF_RENDERED_DRIVE_HPP

#include "street_renderer.hpp"
#include <functional>

namespace experiments {

/** A car in a straight street with walls to both sides, 30 frames a second. */
class RenderedDrive
{
public:
    enum Course {
        //! 12 m/s, from 1 to 2 s without a left wall, a bend to and fro from 2.5 to 6.5 s, standing from 7.2 to 8.2 s
        BEND_AND_STOP,
        WEAVING,       //!< 12 m/s, to and fro all the time
        CHANGING_WALLS //!< the same, with gaps of 1.5 s in each wall, every 5 s, that overlap for half a second
    };

    Course course;
    std::function<double(double)> sway[2]; //!< the suspension's roll and pitch at a time, radians
    double phase;                          //!< of weaving, radians

    //! @param camera as it is mounted. @param street its yawRate, speed, left, right, wallDirection and travelled are
    //! those of the drive.
    RenderedDrive(const street::StreetCamera& camera, const street::StreetScene& street);

    //! Drives on to the next frame.
    street::StreetRenderer next();

    // of the last frame
    double seconds() const { return seconds_; }
    double speed() const { return scene.speed; }
    double yawRate() const { return scene.yawRate; }

private:
    double speedAt(double seconds) const;
    double yawRateAt(double seconds) const;
    void drive();
    bool hasWall(int side) const; // 0: left, 1: right

    const street::StreetCamera mounted;
    street::StreetScene scene;
    int frames;
    double seconds_, sideways, yaw; // metres and radians to the right
};

} // namespace experiments

#endif // RSACKERMANN_PERF_RENDERED_DRIVE_HPP
