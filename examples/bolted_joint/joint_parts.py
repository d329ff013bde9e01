# SPDX-License-Identifier: BSD-3-Clause
"""The joint: dimensions [mm, N, MPa], elastic constants, and theory of its thread."""
import math
from dataclasses import dataclass

YOUNG, POISSON = 210000.0, 0.3
TURNS = 6  # of the nut's thread


@dataclass
class Joint:
    """M20 x 2.5: nut ISO 4032, reduced shank (as thick as the pitch diameter, ISO 4015), two plates in one."""
    pitch: float = 2.5
    diameter: float = 20.0
    half_angle: float = 30.0
    nut_height: float = 18.0
    across: float = 30.0        # outer diameter of nut and head
    head_height: float = 12.5
    grip: float = 40.0          # the plate is z = -grip .. 0
    hole: float = 22.0
    plate: float = 60.0         # its outer diameter
    threaded: tuple = (-7.5, 20.0)  # of the bolt
    clearance: float = 0.05     # of the flank without load, along the axis, and of the nut's root, radially
    stretch: float = 0.17       # by which the shank is shortened to tighten the joint
    embedding: float = 0.008    # by which the plate becomes thinner afterwards

    @property
    def tan(self):
        return math.tan(math.radians(self.half_angle))

    @property
    def height_of_triangle(self):
        return self.pitch / (2 * self.tan)

    @property
    def pitch_radius(self):  # d2 / 2 = D2 / 2
        return self.diameter / 2 - 0.375 * self.height_of_triangle

    @property
    def root_radius(self):  # d3 / 2 of the bolt
        return self.diameter / 2 - 17 / 24 * self.height_of_triangle

    @property
    def bore_radius(self):  # D1 / 2 of the nut
        return self.diameter / 2 - 0.625 * self.height_of_triangle

    @property
    def stress_radius(self):  # of the stress area, (d2 + d3) / 4 (ISO 898-1)
        return (self.pitch_radius + self.root_radius) / 2

    @property
    def nut_ridge(self):
        """Place along the axis of the middle of the nut's ridge, where its thread begins."""
        return (self.nut_height - TURNS * self.pitch) / 2

    @property
    def bolt_ridge(self):
        """Of the bolt's ridge whose lower flank lies on that one's upper flank."""
        return self.nut_ridge + (self.pitch - self.clearance) / 2

    def half_width(self, radius):
        """Of the bolt's ridge."""
        return self.pitch / 4 - (radius - self.pitch_radius) * self.tan


def tooth_compliances(joint, base, depth):
    """[bending, shear, inclination of the root, shear of the root]: E times the displacement along the axis per force along the axis and length of helix.

    Yamamoto's cantilever (A. Yamamoto, The theory and computation of threads connection, 1980): `base` thick at the root, p / 2 at the pitch line, `depth` between both.
    """
    a, b, c, p, nu = base, joint.pitch / 2, depth, joint.pitch, POISSON
    tan, cot = joint.tan, 1 / joint.tan
    bending = (1 - nu ** 2) * 3 / 4 * ((1 - (2 - b / a) ** 2 + 2 * math.log(a / b)) * cot ** 3 - 4 * (c / a) ** 2 * tan)
    shear = (1 + nu) * 6 / 5 * cot * math.log(a / b)
    inclination = (1 - nu ** 2) * 12 * c / (math.pi * a ** 2) * (c - b / 2 * tan)
    root = (1 - nu ** 2) * 2 / math.pi * (p / a * math.log((p + a / 2) / (p - a / 2)) + 0.5 * math.log(4 * p ** 2 / a ** 2 - 1))
    return [bending, shear, inclination, root]


def compliances(joint):
    """Of the bolt's and of the nut's ridge."""
    r2, bolt, nut = joint.pitch_radius, joint.root_radius, joint.diameter / 2
    return (tooth_compliances(joint, 2 * joint.half_width(bolt), r2 - bolt),
            tooth_compliances(joint, joint.pitch - 2 * joint.half_width(nut), nut - r2))


def teeth_stiffness(joint):
    """Of Yamamoto's cantilevers against force along the flank's normal, per length of helix: a gap u cos(alpha) closes, the force along the axis is
    cos(alpha) times the normal one."""
    return YOUNG / sum(map(sum, compliances(joint))) / math.cos(math.radians(joint.half_angle)) ** 2


def yamamoto(joint):
    """Shares of the turns: F'' = lambda^2 F, all the force at the loaded face and none at the other end (bolt in tension, nut in compression)."""
    r2, p, nu = joint.pitch_radius, joint.pitch, POISSON
    bolt, nut = (sum(each) for each in compliances(joint))
    outer = joint.across / 2
    bolt += (1 - nu) * joint.tan ** 2 / 2 * 2 * r2 / p
    nut += ((outer ** 2 + r2 ** 2) / (outer ** 2 - r2 ** 2) + nu) * joint.tan ** 2 / 2 * 2 * r2 / p
    area_bolt, area_nut = math.pi * joint.stress_radius ** 2, math.pi * (outer ** 2 - r2 ** 2)
    # dF/dz = (force per length of helix) x (length of helix per height)
    per_height = math.hypot(1, 2 * math.pi * r2 / p)
    root = math.sqrt((1 / area_bolt + 1 / area_nut) * per_height / (bolt + nut))
    turns = [math.sinh(root * (TURNS - i) * p) for i in range(TURNS + 1)]
    return [(turns[i] - turns[i + 1]) / turns[0] for i in range(TURNS)], root
