// Tells the learning platform that opened this page that the registration is done (1EdTech Dynamic Registration 1.0).
(window.opener || window.parent).postMessage({ subject: 'org.imsglobal.lti.close' }, '*');
