"""Geometry, loads and axes of the contact problem.

The z axis points into the lower body. The upper body approaches by delta_n under the normal force P and is displaced
by delta under the tangential force Q; a is the contact radius, h the coating thickness, g the gap outside the contact.
Deformation exaggerated.
"""

from _figures import figure, save
from _sketch import contact

drawn, axes = figure(height=62, wide=False)
contact(axes)
save(drawn)
