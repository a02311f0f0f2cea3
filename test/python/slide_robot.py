"""The robot of the Python tests."""

# A ball on a slide along x, 0.7 m above another on the base.
SLIDE = """
<robot name="slide">
  <link name="base"><collision><geometry><sphere radius="0.1"/></geometry></collision></link>
  <link name="carriage"><collision><geometry><sphere radius="0.01"/></geometry></collision></link>
  <link name="ball"><collision><geometry><sphere radius="0.05"/></geometry></collision></link>
  <joint name="slide" type="prismatic">
    <parent link="base"/><child link="carriage"/><origin xyz="0 0 0.5"/><axis xyz="1 0 0"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/>
  </joint>
  <joint name="rod" type="fixed"><parent link="carriage"/><child link="ball"/><origin xyz="0 0 0.2"/></joint>
</robot>
"""
