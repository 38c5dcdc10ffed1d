// SPDX-License-Identifier: Apache-2.0
const icon = (path) => `<svg viewBox="0 0 16 16" aria-hidden="true"><path d="${path}"/></svg>`;

export const icons = {
  play: icon('M4.5 2.6v10.8a.6.6 0 0 0 .9.5l8.6-5.4a.6.6 0 0 0 0-1L5.4 2.1a.6.6 0 0 0-.9.5z'),
  pause: icon('M4 2.5h3v11H4zM9 2.5h3v11H9z'),
  back: icon('M3 3h1.8v10H3zM13 3.4v9.2a.5.5 0 0 1-.8.4L6 8.4a.5.5 0 0 1 0-.8L12.200 3a.5.5 0 0 1 .8.4z'),
  forth: icon('M13 3h-1.800v10H13zM3 3.400v9.200a.5.5 0 0 0 .8.4L10 8.400a.5.5 0 0 0 0-.8L3.800 3a.5.5 0 0 0-.8.4z'),
  loop: icon('M4.500 4H11V2l3.500 3L11 8V6H4.500C3.700 6 3 6.700 3 7.500S3.700 9 4.500 9H5v2h-.5a3.500 3.500 0 0 1 0-7zM11.500 12H5v2l-3.500-3L5 8v2h6.500c.8 0 1.500-.7 1.500-1.500h2a3.500 3.500 0 0 1-3.500 3.500z'),
  more: icon('M2 4h7v1.600H2zM12 4h2v1.600h-2zM9.700 2.800h1.600v4H9.700zM2 10.400h2v1.600H2zM7 10.400h7v1.600H7zM4.700 9.200h1.600v4H4.700z'),
};
