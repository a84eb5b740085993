// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_TEST_RSACKERMANN_SYMMETRY_HPP
#define OPENCV_TEST_RSACKERMANN_SYMMETRY_HPP

#include "test_precomp.hpp"

namespace opencv_test {

/** What is seen in a mirror, what a car that drives backward along the same way shows if its camera reads its lines in
the other order (the same image), and what a camera shows that is mounted on its side or on its head. None uses a
formula of the library. */
struct Twin
{
    bool mirrored, reversed;
    int turned; // by quarters of a circle, as the image is, clockwise

    RollingShutterCamera of(RollingShutterCamera c) const
    {
        if (reversed)
            c.scanDirection ^= 1;
        if (mirrored)
            c = mirror(c);
        for (int i = 0; i < turned; i++)
            c = turn(c);
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
        if (mirrored)
            m = mirror(m, camera);
        return turned ? turn(m, camera) : m;
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

    Size of(const Size& size) const { return turned % 2 ? Size(size.height, size.width) : size; }

    //! An image, or a map of one.
    Mat ofImage(const Mat& image) const
    {
        Mat result = image.clone();
        if (image.empty())
            return result;
        if (mirrored)
            flip(result, result, 1);
        for (int i = 0; i < turned; i++)
            cv::rotate(result.clone(), result, ROTATE_90_CLOCKWISE);
        return result;
    }

    DepthMap of(DepthMap depth, const RollingShutterCamera& camera) const
    {
        depth.values = ofImage(depth.values);
        if (depth.kind == DEPTH_RELATIVE)
        {
            depth.scale *= unitOf(camera);
            depth.shift *= unitOf(camera);
        }
        return depth;
    }

    //! Maps to an image of a size, in which some pixels may have no place.
    void ofMaps(Mat& x, Mat& y, const Size& size) const
    {
        const Mat none = ofImage(x == -16384);
        std::vector<Mat> places = {x.reshape(1, int(x.total())), y.reshape(1, int(y.total()))};
        hconcat(places, places[0]);
        places[0] = ofPlaces(places[0], size);
        x = ofImage(places[0].col(0).clone().reshape(1, x.rows));
        y = ofImage(places[0].col(1).clone().reshape(1, y.rows));
        x.setTo(-16384, none);
        y.setTo(-16384, none);
    }

    //! Rows of x, y, ...
    Mat ofPlaces(const Mat& places, const Size& size) const
    {
        Mat result = places.clone();
        for (int i = 0; i < result.cols; i += 2)
        {
            Mat x = result.col(i), y = result.col(i + 1);
            if (mirrored)
                x = size.width - 1 - x;
            for (int k = 0; k < turned; k++)
            {
                const Mat before = x.clone();
                x = (k % 2 ? size.width : size.height) - 1 - y;
                before.copyTo(y);
            }
        }
        return result;
    }

    //! Of intrinsic parameters.
    Matx33d of(Matx33d K, Size size) const
    {
        if (mirrored && K(0, 0) > 0)
            K(0, 2) = size.width - 1 - K(0, 2);
        for (int i = 0; i < turned; i++, std::swap(size.width, size.height))
            K = turn(K, size);
        return K;
    }

    //! A pose of the camera, whose unit of length is the way in a unit of time.
    void ofPose(const RollingShutterCamera& camera, Matx33d& R, Vec3d& T) const
    {
        R = mirrored ? mirror(R) : R;
        T[0] *= mirrored ? -1 : 1;
        for (int i = 0; i < turned; i++)
        {
            const Matx33d quarter = quarterTurn();
            R = quarter * R * quarter.t();
            T = quarter * T;
        }
        T *= 1 / unitOf(camera);
    }

    //! What a gyro measures about the axes of the camera.
    Vec3d ofRates(Vec3d rates) const
    {
        if (mirrored)
            rates = Vec3d(rates[0], -rates[1], -rates[2]);
        for (int i = 0; i < turned; i++)
            rates = quarterTurn() * rates;
        return rates;
    }

private:
    RollingShutterCamera mirror(RollingShutterCamera c) const
    {
        c.cameraMatrix(0, 2) = c.imageSize.width - 1 - c.cameraMatrix(0, 2);
        if (!c.isRowShutter())
        {
            c.scanDirection ^= 1;
            c.referenceRow = c.imageSize.width - 1 - c.referenceRow;
        }
        if (c.lensModel == LENS_PINHOLE)
            for (const size_t odd : {3, 8, 9, 13}) // p2, s1, s2 and the tilt about the y axis
                if (odd < c.distCoeffs.size())
                    c.distCoeffs[odd] *= -1;
        c.uprightRotation = mirror(c.uprightRotation);
        c.heading = -c.heading;
        return c;
    }

    static Matx33d mirror(const Matx33d& R)
    {
        const Matx33d sides = Matx33d::diag(Vec3d(-1, 1, 1));
        return sides * R * sides;
    }

    //! Of places.
    static Matx33d quarterTurn() { return Matx33d(0, -1, 0, 1, 0, 0, 0, 0, 1); }

    static RollingShutterCamera turn(RollingShutterCamera c)
    {
        const int scans[] = {SCAN_RIGHT_TO_LEFT, SCAN_LEFT_TO_RIGHT, SCAN_TOP_TO_BOTTOM, SCAN_BOTTOM_TO_TOP};
        if (c.isRowShutter())
            c.referenceRow = c.imageSize.height - 1 - c.referenceRow;
        c.scanDirection = scans[c.scanDirection];
        c.cameraMatrix = turn(c.cameraMatrix, c.imageSize);
        std::swap(c.imageSize.width, c.imageSize.height);
        c.uprightRotation = c.uprightRotation * quarterTurn().t();
        std::vector<double>& k = c.distCoeffs;
        // The x and y of the vectors p, s and of the axis of the tilt, which has one of both
        const int pairs[][2] = {{3, 2}, {8, 10}, {9, 11}, {12, 13}};
        for (const auto& pair : pairs)
            if (c.lensModel == LENS_PINHOLE && std::max(pair[0], pair[1]) < int(k.size()))
            {
                std::swap(k[pair[0]], k[pair[1]]);
                k[pair[0]] *= -1;
            }
        CV_Assert(k.size() < 14 || k[12] == 0 || k[13] == 0);
        return c;
    }

    static Matx33d turn(const Matx33d& K, const Size& size)
    {
        return K(0, 0) > 0 ? Matx33d(K(1, 1), 0, size.height - 1 - K(1, 2), 0, K(0, 0), K(0, 2), 0, 0, 1) : K;
    }

    static AckermannMotion mirror(AckermannMotion m, const RollingShutterCamera& camera)
    {
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
        for (double* value :
             {&m.alpha, &m.rollRate, &m.rollCorrection, &m.headingCorrection, &m.seenYawRate, &m.seenHeading})
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

    // Upright frames are the same; the new unit of time over the old one, as either focal length makes it.
    double unitOf(const RollingShutterCamera& camera) const
    {
        return turned % 2 ? camera.cameraMatrix(0, 0) / camera.cameraMatrix(1, 1) : 1;
    }

    AckermannMotion turn(AckermannMotion m, const RollingShutterCamera& camera) const
    {
        const double unit = unitOf(camera);
        for (double* value : {&m.alpha, &m.wallSlope, &m.wallOffset, &m.roadSlope, &m.pitchRate, &m.rollRate})
            *value *= unit;
        m.inverseDepthOffset *= unit;
        changeCovariance(m, Matx44d::diag(Vec4d(unit, unit, unit, 1)));
        const bool isTopLast = (turned % 4 == 1 && camera.isRowShutter()) || turned % 4 == 2 ||
                               (turned % 4 == 3 && !camera.isRowShutter());
        if (isTopLast && !m.rotationCurve.empty())
            flip(m.rotationCurve, m.rotationCurve, 0);
        return m;
    }

    static void changeCovariance(AckermannMotion& m, const Matx44d& J) { m.covariance = J * m.covariance * J.t(); }
};

const Twin MIRRORED = {true, false, 0}, REVERSED = {false, true, 0}, ON_ITS_SIDE = {false, false, 1},
           ON_ITS_HEAD = {false, false, 2}, MIRRORED_ON_ITS_HEAD = {true, false, 2};

inline std::ostream& operator<<(std::ostream& out, const Twin& twin)
{
    return out << (twin.mirrored ? "mirrored " : "") << (twin.reversed ? "reversed " : "") << "turned " << twin.turned;
}

} // namespace opencv_test

#endif // OPENCV_TEST_RSACKERMANN_SYMMETRY_HPP
