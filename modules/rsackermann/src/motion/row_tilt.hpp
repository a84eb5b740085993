// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_MOTION_ROW_TILT_HPP
#define OPENCV_RSACKERMANN_SRC_MOTION_ROW_TILT_HPP

#include "opencv2/rsackermann/motion.hpp"
#include "../camera/axis_rotations.hpp"
#include "compensation.hpp"

namespace cv { namespace rsackermann {

/** AckermannMotion::rotationCurve: a natural cubic spline through its rotation vectors, straight beyond the image
(doc/theory.md, "Rates of rows"). It has no edges but in its third derivative, which maps interpolate. */
class RotationCurve
{
public:
    //! Throws cv::Exception if the vectors aren't those of a curve.
    RotationCurve(const RollingShutterCamera& camera, const Mat& vectors);

    bool empty() const { return values.empty(); }

    //! The rotation vector in the upright frame at a row time. The curve must not be empty.
    Vec3d at(double time) const;

    //! Frame of the camera at a row time to that of one that turns at its rates alone.
    Matx33d rotation(double time) const;

    //! How many of the pieces between two values two row times span.
    double pieces(double from, double to) const { return std::abs((to - from) * perTime); }

    //! Whether a matrix of that size can be a curve.
    static bool isPossible(const Size& size) { return size.width == 3 && size.height > 1 && size.height <= MOST; }
    //! What is possible, in words.
    static String possibleSizes() { return format("from 2 x 3 to %d x 3 values", MOST); }

private:
    enum { MOST = 1024 };

    static void check(const Mat& vectors);

    std::vector<Vec3d> values, bends; // second derivatives, by pieces
    double time0, perTime;            // of the first value; pieces per row time, negative if rows go upward
};

//! How a row is turned beside the car's yaw: by the rates of roll and pitch and by the curve (doc/theory.md, "Motion").
class RowTilt
{
public:
    RowTilt(const RollingShutterCamera& camera, const AckermannMotion& motion)
        : curve(camera, motion.rotationCurve), rollRate(motion.rollRate), pitchRate(motion.pitchRate),
          none(rollRate == 0 && pitchRate == 0 && curve.empty())
    {
    }

    bool isNone() const { return none; }

    //! Upright frame of a row to that of one that only yaws.
    Matx33d at(double time) const
    {
        const double roll = rollRate * time, pitch = pitchRate * time;
        double sincRoll, cosRoll, sincPitch, cosPitch;
        sincAndCos(roll, sincRoll, cosRoll);
        sincAndCos(pitch, sincPitch, cosPitch);
        const Matx33d steady = tiltRotation(roll * sincRoll, cosRoll, pitch * sincPitch, cosPitch);
        return curve.empty() ? steady : steady * curve.rotation(time);
    }

    //! The rotation vector of at() to first order.
    Vec3d vector(double time) const
    {
        const Vec3d steady(-pitchRate * time, 0, rollRate * time);
        return curve.empty() ? steady : steady + curve.at(time);
    }

    RotationCurve curve;

private:
    double rollRate, pitchRate;
    bool none;
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_MOTION_ROW_TILT_HPP
