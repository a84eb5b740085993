// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../compensation.hpp"
#include "consensus.hpp"
#include "vertical_residual.hpp"

namespace cv {
namespace rsackermann {

CandidateConsensus::CandidateConsensus(const RefinementProblem& problem_, const Structure& structure_, double threshold_)
    : problem(problem_), structure(structure_), threshold(threshold_), verticals(problem_.candidates->size())
{
    for (size_t i = 0; i < verticals.size(); i++)
    {
        const Candidate& c = (*problem.candidates)[i];
        verticals[i].u = Point2d(c.u[0], c.u[2]);
        verticals[i].v = Point2d(c.v[0], c.v[2]);
        verticals[i].timeU = c.timeU;
        verticals[i].timeV = c.timeV;
    }
}

int CandidateConsensus::solve(const VerticalSegment* segments, MinimalSolution* solutions) const
{
    SolverOptions options;
    options.heading = problem.heading;
    options.maxAlpha = problem.limits.maxAlpha;
    options.maxSpeed = problem.limits.maxSpeed;
    options.rollingShutterDepth = false;
    const bool twoWalls = structure.walls == 2;
    switch (structure.motion)
    {
    case MODEL_1LA: return solve1LA(segments[0], options, solutions);
    case MODEL_3LA: return solve3LA(segments, twoWalls, options, solutions);
    default: return solve4LA(segments, twoWalls, options, solutions);
    }
}

// Sign of the scaled inverse depth at the end u of a segment on the left (or only) wall.
int CandidateConsensus::directionOf(const MinimalSolution& s, const VerticalSegment& left) const
{
    const TurnedBearing u(left.u, RowMotion(s.alpha, problem.heading, left.timeU));
    return s.D - s.B * u.column(s.B, s.D) > 0 ? 1 : -1;
}

int CandidateConsensus::generate(const int* sample, Model* models)
{
    const int n = sampleSize();
    const int arrangements = structure.walls == 2 ? 2 : 1;
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
            if (structure.translates())
                m.direction = directionOf(s, segments[0]);
            // The other wall of a mirrored solution is the left one.
            const double scale = mirrored ? -s.lambda : 1;
            m[P_B] = scale * s.B;
            m[P_D] = scale * s.D;
            m[P_LAMBDA] = mirrored ? 1 / s.lambda : s.lambda;
        }
    }
    return count;
}

double CandidateConsensus::score(const Model& model, double best, int& inliers) const
{
    const double limit = threshold * threshold;
    double sum = 0;
    inliers = 0;
    for (size_t i = 0; i < problem.candidates->size() && sum < best; i++)
    {
        int wall;
        const double r = problem.focal * verticalResidual((*problem.candidates)[i], model, problem.heading, wall, 0);
        inliers += r * r < limit;
        sum += std::min(r * r, limit);
    }
    return sum;
}

void CandidateConsensus::optimize(Model& model) const
{
    refine(problem, structure, 4, model);
}

}} // namespace cv::rsackermann
