// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../motion/compensation.hpp"
#include "consensus.hpp"
#include "../factors/residual_kernels.hpp"

namespace cv { namespace rsackermann {

CandidateConsensus::CandidateConsensus(const RefinementProblem& problem_, const MotionHypothesis& hypothesis_,
                                       double threshold_)
    : problem(problem_), hypothesis(hypothesis_), threshold(threshold_), verticals(problem_.verticals.size())
{
    for (size_t i = 0; i < verticals.size(); i++)
    {
        const UprightSegment& c = problem.verticals[i];
        verticals[i].u = HorizontalBearing(c.u[0], c.u[2]);
        verticals[i].v = HorizontalBearing(c.v[0], c.v[2]);
        verticals[i].timeU = c.timeU;
        verticals[i].timeV = c.timeV;
    }
}

int CandidateConsensus::solve(const VerticalSegment* segments, MinimalSolution* solutions) const
{
    SolverOptions options;
    options.heading = problem.heading.angle;
    options.maxAlpha = problem.limits.maxAlpha;
    options.maxScaledSpeed = problem.limits.maxRightScaledSpeed; // either wall may be the first one
    const bool twoWalls = hypothesis.walls == 2;
    switch (hypothesis.motion)
    {
    case MODEL_1LA:
        return solve1LA(segments[0], options, solutions);
    case MODEL_3LA:
        return solve3LA(segments, twoWalls, options, solutions);
    default:
        return solve4LA(segments, twoWalls, options, solutions);
    }
}

// Sign of the scaled inverse depth at the end u of a segment on the left (or only) wall.
int CandidateConsensus::directionOf(const MinimalSolution& s, const VerticalSegment& left) const
{
    const RotatedBearing u(left.u, RowMotion(s.alpha, problem.heading, left.timeU));
    return s.wallOffset - s.wallSlope * u.column(s.wallSlope, s.wallOffset) > 0 ? 1 : -1;
}

int CandidateConsensus::generate(const int* sample, Model* models)
{
    const int n = sampleSize();
    const int arrangements = hypothesis.walls == 2 ? 2 : 1;
    int count = 0;
    for (int mirrored = 0; mirrored < arrangements; mirrored++)
    {
        VerticalSegment segments[4];
        for (int i = 0; i < n; i++)
            segments[i] = verticals[sample[mirrored ? n - 1 - i : i]];
        MinimalSolution solutions[8];
        const int found = solve(segments, solutions);
        for (int i = 0; i < found; i++)
        {
            const MinimalSolution& s = solutions[i];
            Model& m = models[count++];
            m = Model();
            m[P_ALPHA] = s.alpha;
            if (hypothesis.translates())
                m.direction = directionOf(s, segments[0]);
            m[P_B] = s.wallSlope;
            m[P_D] = s.wallOffset;
            m[P_LAMBDA] = s.wallRatio;
            m = withLeftWallFirst(m, problem.heading);
            if (!problem.limits.allow(m))
                count--;
        }
    }
    return count;
}

double CandidateConsensus::score(const Model& model, double best, int& inliers) const
{
    return scoreVerticals(problem.verticalArrays, PreparedModel(model, problem.heading), problem.focal, threshold, best,
                          inliers);
}

}} // namespace cv::rsackermann
