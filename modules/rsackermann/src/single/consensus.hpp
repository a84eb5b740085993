// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_SINGLE_CONSENSUS_HPP
#define OPENCV_RSACKERMANN_SRC_SINGLE_CONSENSUS_HPP

#include "opencv2/rsackermann/solvers.hpp"
#include "refinement.hpp"

namespace cv { namespace rsackermann {

/** Consensus of the candidates on one motion hypothesis; the Estimator of loRansac().

Samples for two walls take all but one of their segments from one side of the image and the last one from the other
side: the three leftmost on the left wall and the rightmost on the right wall, and the mirror image of it.
*/
class CandidateConsensus
{
public:
    typedef rsackermann::Model Model;
    enum { MAX_MODELS = 16 };

    //! @param candidates from left to right.
    CandidateConsensus(const RefinementProblem& problem, const MotionHypothesis& hypothesis, double threshold);

    int size() const { return (int)problem.verticals.size(); }
    int sampleSize() const { return hypothesis.unknowns(); }
    int generate(const int* sample, Model* models);
    double score(const Model& model, double best, int& inliers) const;
    void optimize(Model& model) const { refine(problem, hypothesis, VERTICALS_ONLY, 4, model); }

private:
    int solve(const VerticalSegment* segments, MinimalSolution* solutions) const;
    int directionOf(const MinimalSolution& solution, const VerticalSegment& left) const;

    const RefinementProblem& problem;
    MotionHypothesis hypothesis;
    double threshold;
    std::vector<VerticalSegment> verticals;
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_SINGLE_CONSENSUS_HPP
