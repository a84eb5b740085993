// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_TEST_RSACKERMANN_SYMMETRY_HPP
#define OPENCV_TEST_RSACKERMANN_SYMMETRY_HPP

#include "test_precomp.hpp"

namespace opencv_test {

/** What is seen in a mirror, and what a car that drives backward along the same way shows if its camera reads its lines
in the other order: the same image. Neither uses a formula of the library. */
struct Twin
{
    bool mirrored, reversed;

    RollingShutterCamera of(RollingShutterCamera c) const
    {
        if (reversed)
            c.scanDirection ^= 1;
        if (!mirrored)
            return c;
        c.cameraMatrix = of(c.cameraMatrix, c.imageSize);
        if (!c.isRowShutter())
        {
            c.scanDirection ^= 1;
            c.referenceRow = c.imageSize.width - 1 - c.referenceRow;
        }
        if (c.lensModel == LENS_PINHOLE)
            for (const size_t odd : {3, 8, 9, 13}) // p2, s1, s2 and the tilt about the y axis
                if (odd < c.distCoeffs.size())
                    c.distCoeffs[odd] *= -1;
        c.uprightRotation = of(c.uprightRotation);
        c.heading = -c.heading;
        return c;
    }

    AckermannMotion of(AckermannMotion m, const RollingShutterCamera& camera) const
    {
        m.inverseDepthOffset = m.inverseDepthOffset.clone();
        m.rotationCurve = m.rotationCurve.clone();
        if (reversed)
        {
            m.direction *= -1;
            for (double* value : {&m.alpha, &m.wallSlope, &m.wallOffset, &m.roadSlope, &m.pitchRate, &m.rollRate,
                                  &m.seenYawRate, &m.seenSpeed})
                *value *= -1;
            m.inverseDepthOffset *= -1;
            changeCovariance(m, Matx44d::diag(Vec4d(-1, -1, -1, 1)));
        }
        if (!mirrored)
            return m;
        if (m.wallRatio > 0)
        {
            const double ratio = m.wallRatio, B = m.wallSlope, D = m.wallOffset;
            changeCovariance(m, Matx44d(-1, 0, 0, 0, 0, ratio, 0, B, 0, 0, -ratio, -D, 0, 0, 0, -1 / (ratio * ratio)));
            m.wallSlope = ratio * B;
            m.wallOffset = -ratio * D;
            m.wallRatio = 1 / ratio;
            m.wallDistance /= ratio;
        }
        else
        {
            changeCovariance(m, Matx44d::diag(Vec4d(-1, -1, 1, 1)));
            m.wallSlope *= -1;
        }
        for (double* value : {&m.alpha, &m.rollRate, &m.rollCorrection, &m.seenYawRate})
            *value *= -1;
        if (!m.inverseDepthOffset.empty())
            flip(m.inverseDepthOffset, m.inverseDepthOffset, 1);
        m.offsetArea.x = -m.offsetArea.br().x;
        if (m.rotationCurve.empty())
            return m;
        m.rotationCurve.colRange(1, 3) *= -1;
        if (!camera.isRowShutter())
            flip(m.rotationCurve, m.rotationCurve, 0);
        return m;
    }

    MotionPrior of(MotionPrior p) const
    {
        if (reversed)
        {
            p.speed *= -1;
            p.yawRate *= -1;
        }
        if (mirrored)
        {
            p.yawRate *= -1;
            p.wallDirection *= -1;
        }
        return p;
    }

    //! An image, or a map of one.
    Mat ofImage(const Mat& image) const
    {
        Mat result = image.clone();
        if (mirrored && !image.empty())
            flip(image, result, 1);
        return result;
    }

    //! Columns of places in an image of a width.
    Mat ofColumns(const Mat& columns, int width) const { return mirrored ? Mat(width - 1 - columns) : columns.clone(); }

    //! Rows of x, y, ...
    Mat ofPlaces(const Mat& places, const Size& size) const
    {
        Mat result = places.clone();
        for (int i = 0; mirrored && i < result.cols; i += 2)
            result.col(i) = size.width - 1 - result.col(i);
        return result;
    }

    //! Of intrinsic parameters.
    Matx33d of(Matx33d K, const Size& size) const
    {
        if (mirrored && K(0, 0) > 0)
            K(0, 2) = size.width - 1 - K(0, 2);
        return K;
    }

    //! A rotation.
    Matx33d of(const Matx33d& R) const
    {
        const Matx33d mirror = Matx33d::diag(Vec3d(mirrored ? -1 : 1, 1, 1));
        return mirror * R * mirror;
    }

    Vec3d of(const Vec3d& v) const { return Vec3d(mirrored ? -v[0] : v[0], v[1], v[2]); }

private:
    static void changeCovariance(AckermannMotion& m, const Matx44d& J) { m.covariance = J * m.covariance * J.t(); }
};

const Twin TWINS[] = {{true, false}, {false, true}};

inline std::ostream& operator<<(std::ostream& out, const Twin& twin)
{
    return out << (twin.mirrored ? "mirrored " : "") << (twin.reversed ? "reversed" : "");
}

} // namespace opencv_test

#endif // OPENCV_TEST_RSACKERMANN_SYMMETRY_HPP
