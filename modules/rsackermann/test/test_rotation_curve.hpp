// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_TEST_RSACKERMANN_ROTATION_CURVE_HPP
#define OPENCV_TEST_RSACKERMANN_ROTATION_CURVE_HPP

#include "test_random.hpp"
#include "opencv2/rsackermann/motion.hpp"
#include <functional>

namespace opencv_test {

/** A natural cubic spline through the rows of a matrix at 0, 1, ..., straight beyond them: the coefficients of all
pieces at once, by the conditions that define it. */
class NaturalSpline
{
public:
    explicit NaturalSpline(const Mat& values) : pieces(values.rows - 1)
    {
        Mat A = Mat::zeros(4 * pieces, 4 * pieces, CV_64F), b = Mat::zeros(4 * pieces, values.cols, CV_64F);
        int row = 0;
        for (int i = 0; i < pieces; i++)
        {
            A.at<double>(row, 4 * i) = 1;
            values.row(i).copyTo(b.row(row++));
            A(Rect(4 * i, row, 4, 1)).setTo(1);
            values.row(i + 1).copyTo(b.row(row++));
            if (i + 1 == pieces)
                continue;
            const double slope[5] = {1, 2, 3, 0, -1}, bend[6] = {1, 3, 0, 0, -1, 0}; // the same on both sides
            for (int k = 0; k < 5; k++)
                A.at<double>(row, 4 * i + 1 + k) = slope[k];
            row++;
            for (int k = 0; k < 5; k++)
                A.at<double>(row, 4 * i + 2 + k) = bend[k];
            row++;
        }
        A.at<double>(row++, 2) = 1;
        A.at<double>(row, 4 * pieces - 2) = 1;
        A.at<double>(row, 4 * pieces - 1) = 3;
        cv::solve(A, b, coefficients);
    }

    Vec3d at(double place) const
    {
        const double inside = std::min(std::max(place, 0.), double(pieces));
        const int i = std::min(int(inside), pieces - 1);
        const double f = inside - i;
        Vec3d c[4];
        for (int k = 0; k < 4; k++)
            c[k] = Vec3d(coefficients.ptr<double>(4 * i + k));
        const Vec3d slope = c[1] + 2 * f * c[2] + 3 * f * f * c[3];
        return c[0] + f * c[1] + f * f * c[2] + f * f * f * c[3] + (place - inside) * slope;
    }

private:
    int pieces;
    Mat coefficients;
};

//! The rotation vectors of a motion's curve by row time; empty if it has none.
inline std::function<Vec3d(double)> rotationCurveOf(const cv::rsackermann::RollingShutterCamera& camera,
                                                    const cv::rsackermann::AckermannMotion& motion)
{
    if (motion.rotationCurve.empty())
        return std::function<Vec3d(double)>();
    const NaturalSpline spline(motion.rotationCurve);
    const bool byColumns = camera.scanDirection == cv::rsackermann::SCAN_LEFT_TO_RIGHT ||
                           camera.scanDirection == cv::rsackermann::SCAN_RIGHT_TO_LEFT,
               reversed = camera.scanDirection == cv::rsackermann::SCAN_BOTTOM_TO_TOP ||
                          camera.scanDirection == cv::rsackermann::SCAN_RIGHT_TO_LEFT;
    const double perTime = (reversed ? -1 : 1) * camera.cameraMatrix(1, 1), reference = camera.referenceRow,
                 lines = (byColumns ? camera.imageSize.width : camera.imageSize.height) - 1,
                 perLine = (motion.rotationCurve.rows - 1) / lines;
    return [=](double time) { return spline.at((reference + time * perTime) * perLine); };
}

//! Any curve whose vectors are far enough apart that rows see everything once.
inline void addRotationCurve(cv::rsackermann::AckermannMotion& motion, int vectors, RNG& rng)
{
    const double largest = std::min(0.01, 0.01 / vectors); // radians
    motion.rotationCurve.create(vectors, 3, CV_64F);
    rng.fill(motion.rotationCurve, RNG::UNIFORM, -largest, largest);
}

} // namespace opencv_test

#endif // OPENCV_TEST_RSACKERMANN_ROTATION_CURVE_HPP
