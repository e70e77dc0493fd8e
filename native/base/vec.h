// base/vec.h - small arithmetic on DpVec3 and DpQuat.
#pragma once
#include <math.h>

#include "base/types.h"

static inline DpVec3 dp_vec3(double x, double y, double z)
{
    const DpVec3 v = {x, y, z};
    return v;
}

static inline DpVec3 dp_add(DpVec3 a, DpVec3 b)
{
    return dp_vec3(a.x + b.x, a.y + b.y, a.z + b.z);
}

static inline DpVec3 dp_sub(DpVec3 a, DpVec3 b)
{
    return dp_vec3(a.x - b.x, a.y - b.y, a.z - b.z);
}

static inline DpVec3 dp_scale(DpVec3 a, double s)
{
    return dp_vec3(a.x * s, a.y * s, a.z * s);
}

static inline double dp_dot(DpVec3 a, DpVec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline DpVec3 dp_cross(DpVec3 a, DpVec3 b)
{
    return dp_vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

static inline double dp_length(DpVec3 a)
{
    return sqrt(dp_dot(a, a));
}

// the vector of length 1 along a; zero stays zero
static inline DpVec3 dp_unit(DpVec3 a)
{
    const double length = dp_length(a);
    return length > 0.0 ? dp_scale(a, 1.0 / length) : a;
}

// v turned by the unit quaternion q
static inline DpVec3 dp_turn(DpQuat q, DpVec3 v)
{
    const DpVec3 u = dp_vec3(q.x, q.y, q.z);
    const DpVec3 t = dp_scale(dp_cross(u, v), 2.0);
    return dp_add(dp_add(v, dp_scale(t, q.w)), dp_cross(u, t));
}

// a point of the part's frame, in the world
static inline DpVec3 dp_place(DpPose pose, DpVec3 point)
{
    return dp_add(pose.at, dp_turn(pose.turn, point));
}

// first b, then a
static inline DpQuat dp_quat_product(DpQuat a, DpQuat b)
{
    const DpQuat q = {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z,
                      a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
                      a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
                      a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
    return q;
}

// the turn back
static inline DpQuat dp_quat_back(DpQuat q)
{
    const DpQuat back = {q.w, -q.x, -q.y, -q.z};
    return back;
}

// by an angle [rad] about a unit axis
static inline DpQuat dp_quat_about(DpVec3 axis, double angle)
{
    const double s = sin(0.5 * angle);
    const DpQuat q = {cos(0.5 * angle), s * axis.x, s * axis.y, s * axis.z};
    return q;
}

// the shortest path from a (w = 0) to b (w = 1) on the unit sphere
static inline DpQuat dp_slerp(DpQuat a, DpQuat b, double w)
{
    double dot = a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z;
    double sign = 1.0;
    if (dot < 0.0) {
        dot = -dot;
        sign = -1.0;
    }
    double wa = 1.0 - w, wb = w;
    if (dot < 0.9995) {
        const double angle = acos(dot);
        wa = sin((1.0 - w) * angle) / sin(angle);
        wb = sin(w * angle) / sin(angle);
    }
    wb *= sign;
    DpQuat q = {wa * a.w + wb * b.w, wa * a.x + wb * b.x, wa * a.y + wb * b.y, wa * a.z + wb * b.z};
    const double size = sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    q.w /= size, q.x /= size, q.y /= size, q.z /= size;
    return q;
}

static inline double dp_clamp(double x, double low, double high)
{
    return x < low ? low : x > high ? high : x;
}

// 0 below 0, 1 above 1, smooth between
static inline double dp_smoothstep(double x)
{
    const double t = dp_clamp(x, 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}
