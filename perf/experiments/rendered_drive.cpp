// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "rendered_drive.hpp"

namespace experiments {

// Metres: width of the street, and from the car to the left wall at the start
static const double FRAMES_PER_SECOND = 30, STREET = 17, TO_THE_LEFT = 6;
static const double TOP_YAW_RATE = 10 * CV_PI / 180, WEAVING_FREQUENCY = CV_PI / 2; // radians

RenderedDrive::RenderedDrive(const street::StreetCamera& camera, const street::StreetScene& street)
    : course(BEND_AND_STOP), phase(0), mounted(camera), scene(street), frames(0), seconds_(0), sideways(0), yaw(0)
{
    sway[0] = sway[1] = [](double) { return 0.; };
    scene.speed = scene.yawRate = scene.travelled = 0;
}

street::StreetRenderer RenderedDrive::next()
{
    scene.frame = unsigned(frames);
    seconds_ = frames++ / FRAMES_PER_SECOND;
    drive();
    street::StreetCamera camera = mounted;
    camera.roll += sway[0](seconds_);
    camera.pitch += sway[1](seconds_);
    scene.wallDirection = mounted.heading - yaw;
    scene.left = hasWall(0) ? TO_THE_LEFT + sideways : 0;
    scene.right = hasWall(1) ? STREET - TO_THE_LEFT - sideways : 0;
    return street::StreetRenderer(camera, scene);
}

bool RenderedDrive::hasWall(int side) const
{
    if (course == BEND_AND_STOP)
        return side != 0 || !(seconds_ > 1 && seconds_ < 2);
    const double period = 5, begin = 1 + side, gap = 1.5, passed = std::fmod(seconds_, period);
    return course == WEAVING || !(passed > begin && passed < begin + gap);
}

double RenderedDrive::speedAt(double seconds) const
{
    if (course != BEND_AND_STOP)
        return 12;
    return seconds < 6 ? 12 : seconds < 7.2 ? 10 * (7.2 - seconds) : seconds < 8.2 ? 0 : 4 * (seconds - 8.2);
}

double RenderedDrive::yawRateAt(double seconds) const
{
    if (course != BEND_AND_STOP)
        return TOP_YAW_RATE * std::sin(seconds * WEAVING_FREQUENCY + phase);
    return seconds > 2.5 && seconds < 6.5 ? TOP_YAW_RATE * std::sin((seconds - 2.5) * WEAVING_FREQUENCY) : 0;
}

void RenderedDrive::drive()
{
    const int steps = 20;
    const double duration = 1 / FRAMES_PER_SECOND / steps;
    if (frames == 1)
    {
        // The angle is an oscillation without an offset from the first frame on.
        if (course != BEND_AND_STOP)
            yaw = -TOP_YAW_RATE / WEAVING_FREQUENCY * std::cos(phase);
    }
    else
        for (int i = 0; i < steps; i++)
        {
            const double at = seconds_ - (steps - 0.5 - i) * duration;
            scene.travelled += speedAt(at) * std::cos(yaw) * duration;
            sideways += speedAt(at) * std::sin(yaw) * duration;
            yaw += yawRateAt(at) * duration;
        }
    scene.speed = speedAt(seconds_);
    scene.yawRate = yawRateAt(seconds_);
}

} // namespace experiments
