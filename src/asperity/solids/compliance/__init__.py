"""Surface compliances: from normal pressure to normal displacement, in Fourier space and patch by
patch."""
