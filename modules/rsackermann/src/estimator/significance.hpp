// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_ESTIMATOR_SIGNIFICANCE_HPP
#define OPENCV_RSACKERMANN_SRC_ESTIMATOR_SIGNIFICANCE_HPP

namespace cv { namespace rsackermann {

/** Natural logarithm of the number of false alarms: how many models fitted to minimal samples would have as many
inliers if the slants of all candidates were random within the gates (doc/theory.md, "Estimation").
@param candidates number of candidates, inliers among them, and candidates of a minimal sample.
@param chance probability that a random candidate is an inlier.
*/
double logFalseAlarms(int candidates, int inliers, int sampleSize, double chance);

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_ESTIMATOR_SIGNIFICANCE_HPP
