// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifdef HAVE_OPENCV_RSACKERMANN
typedef cv::rsackermann::AckermannEstimator::Params AckermannEstimator_Params;
typedef cv::rsackermann::WarpMapGenerator::Params WarpMapGenerator_Params;
#ifndef RSACKERMANN_CORE_ONLY
typedef cv::rsackermann::MountCalibrator::Params MountCalibrator_Params;
typedef cv::rsackermann::RollingShutterCorrector::Params RollingShutterCorrector_Params;
#endif
#endif
