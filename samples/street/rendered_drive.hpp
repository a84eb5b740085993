// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_RENDERED_DRIVE_HPP
#define RSACKERMANN_SAMPLES_RENDERED_DRIVE_HPP

#include "street_renderer.hpp"
#include <functional>

namespace street {

/** A car in a straight street with walls to both sides, 30 frames a second. */
class RenderedDrive
{
public:
    enum Course {
        //! From 1 to 2 s without a left wall, a bend to and fro from 2.5 to 6.5 s, standing from 7.2 to 8.2 s
        BEND_AND_STOP,
        WEAVING,       //!< to and fro all the time, in 4 s
        CHANGING_WALLS //!< the same, with gaps of 1.5 s in each wall, every 5 s, that overlap for half a second
    };

    Course course;
    std::function<double(double)> sway[2]; //!< roll and pitch of all rows of the frame of a time, radians
    double phase;                          //!< of weaving, radians
    double speedSwing; //!< metres per second by which a weaving car is faster at first, and slower after 2 s

    /** @param camera as it is mounted, with its shake.
    @param street its speed is the mean one of the drive, its yawRate the greatest one in bends, its walls those at the
    start; wallDirection and travelled are those of the drive. */
    RenderedDrive(const StreetCamera& camera, const StreetScene& street);

    //! Drives on to the next frame.
    void advance();
    //! The same; the view of the frame.
    StreetRenderer next();

    // of the last frame
    double seconds() const { return seconds_; }
    double speed() const { return scene.speed; }
    double yawRate() const { return scene.yawRate; }
    const StreetScene& street() const { return scene; }
    const StreetCamera& camera() const { return eye; }

    static double framesPerSecond() { return 30; }
    //! Radians per second at which the camera turns about its axes at any time, but for the sway.
    cv::Vec3d ratesAt(double seconds) const;

private:
    double speedAt(double seconds) const;
    double yawRateAt(double seconds) const;
    void drive();
    bool hasWall(int side) const; // 0: left, 1: right

    const StreetCamera mounted;
    StreetCamera eye;
    const StreetScene start;
    StreetScene scene;
    int frames;
    double seconds_, yaw; // radians to the right
};

} // namespace street

#endif // RSACKERMANN_SAMPLES_RENDERED_DRIVE_HPP
